"""What a mechanism and the wear engine both speak of: Hertz line contact and the engagement."""
