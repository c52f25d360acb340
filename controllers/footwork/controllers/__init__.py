"""Decisions: from what a client asks for to the edge to take."""
