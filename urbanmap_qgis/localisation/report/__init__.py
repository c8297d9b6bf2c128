"""Tables, pictures and the report of predicted accuracy."""
