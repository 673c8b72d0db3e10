"""Which chains and teeth of the catalogue carry a power and live as long as they must."""
