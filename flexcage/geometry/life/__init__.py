"""Life as makers quote it: reliability, lubrication and cleanliness (ISO 281), and load spectra."""
