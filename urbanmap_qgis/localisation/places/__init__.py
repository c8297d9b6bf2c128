"""Places along roads: where they lie, what is checked of them, what each deserves to be called."""
