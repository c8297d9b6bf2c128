"""Least squares of what drifts along a path: chains, their factors, and steps as switched latent variables of them.

`block_chain` and `offset_chain` solve, `latent_steps` asks whether the drive or its reference steps.
"""
