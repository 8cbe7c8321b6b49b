"""poise: attitude from inertial samples, with its uncertainty and its reasons."""
__version__="0.1.0"
