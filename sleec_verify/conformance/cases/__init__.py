"""Situations with what they oblige: written down, read, and chosen so that few of them reach all of a ruleset."""
