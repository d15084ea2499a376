"""Pictures: to a PNG (offscreen.py), to MP4 or WebP (video.py), or live in a window (window.py).

`staging.py` is where a scene becomes what the renderer draws, `film.py` runs a simulation into a file.
"""
