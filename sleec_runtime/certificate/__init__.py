"""Certificates on the robot: reading a manifest, and whether it covers the use at hand (docs/certificates.md)."""
