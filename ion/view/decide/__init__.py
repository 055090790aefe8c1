"""Why it decided so at the moment shown, and how it would decide with other terms."""
