"""How C and C++ choose a sample count."""
