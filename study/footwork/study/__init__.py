"""Experiments over both sides: scoring, inspection, pictures."""
