"""Forms: what a file may say as pydantic models, reading one, and saying in one line what is wrong with it.

path --read_text--> text --tomllib--> tables --check_form--> form
"""
