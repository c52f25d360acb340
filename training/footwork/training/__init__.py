"""Offline: files to clips to graph to value iteration to bundle."""
