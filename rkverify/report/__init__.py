"""The pages: ledger, statements, tables and figures as a site that opens from disk."""
