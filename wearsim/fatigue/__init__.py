"""Contact fatigue of flanks: endurance, heat treatments, hours until pitting."""
