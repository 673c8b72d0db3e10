"""The answer about a drive: as text, JSON, tables, pages and a folder."""
