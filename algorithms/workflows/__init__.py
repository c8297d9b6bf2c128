"""Chains: several stages in one run."""
