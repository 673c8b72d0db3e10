"""The input file: documents, units, faults and the keys that all share."""
