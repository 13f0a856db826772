"""How programs choose a sample count."""
