"""Frozen dataclasses that flow between the stages. They hold; they neither read, solve, save nor plot."""
