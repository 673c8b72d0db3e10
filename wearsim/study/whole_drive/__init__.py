"""How long every sprocket of a drive and its one chain live."""
