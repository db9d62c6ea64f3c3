"""Exact and reference solutions, written independently of the solver."""
