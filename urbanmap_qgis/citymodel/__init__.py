"""City models: one record that readers fill and writers take, whatever the format."""
