"""The abstract interpreter of source code: values with conditions, scopes, calls. It knows neither
a language nor an API.
"""
