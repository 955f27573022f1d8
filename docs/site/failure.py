# SPDX-License-Identifier: MIT
"""What ends the making of the site."""


class Failure(Exception):
    """One line for the user."""
