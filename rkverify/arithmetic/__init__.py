"""The scalar fields that the literal transcription runs in; one module each, imported where it is used."""
