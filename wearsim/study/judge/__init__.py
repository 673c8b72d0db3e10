"""Which law of wear readings follow: fitted to one part of them, judged by the rest."""
