"""From a photograph of a worn sprocket to the depth of its wear."""
