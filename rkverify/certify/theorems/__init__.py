"""Theorems over continuous ranges: exact algebra where one or two variables remain, and a log of every proof.

The checker of the logs is `rkverify.recheck`, which shares no line with what is here.
"""
