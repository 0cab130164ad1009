"""Reference values: numbers with certified digits, their inputs as exact rationals, and hashes of both.

A family is a list of cases; a case has inputs (JSON data), equation numbers, a kernel, a reading and values quantity ->
`Certified`, on which the transcription and a route by definition agree. `docs/reference_values.md` describes the files,
`readers/` reads them in Python, C and Octave.
"""
