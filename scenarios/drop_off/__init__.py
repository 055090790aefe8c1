"""The ground falls away beside the track."""
