"""Canonical ids: of chains, of drawn mechanisms, of centre classes."""
