"""Handing a result over: its accuracy in the client's form."""
