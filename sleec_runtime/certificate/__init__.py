"""Certificates on the robot: manifests, signatures, and whether they cover the use of rules (docs/certificates.md)."""
