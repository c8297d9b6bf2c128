"""How parameters and outputs are declared, asked for, and where outputs go."""
