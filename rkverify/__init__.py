"""rkverify: a verification suite for reproducing kernel discretisations with nodal integration."""

__version__ = "0.1.0"
