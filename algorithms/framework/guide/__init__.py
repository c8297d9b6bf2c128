"""The dock that leads from files to results: it shows what the core finds and plans, and runs algorithms."""
