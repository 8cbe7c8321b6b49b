"""SelfCalibrating, our flagship: ``model`` (what is estimated, P over a block), ``causal`` (the method), ``backward`` (the way
back over its blocks) and ``smoother`` (`smooth`, which runs both).
"""
