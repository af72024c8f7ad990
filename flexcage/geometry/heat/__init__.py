"""Heat of a bearing: the bodies between which it flows, conductances, and temperatures."""
