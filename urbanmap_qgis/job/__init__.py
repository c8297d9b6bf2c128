"""What the user has, what he wants and what is run for it: files recognised, chains planned, jobs kept in files."""
