"""Worst cases that a search found: named, kept in a file, measured again, each error beside a bound that is derived."""
