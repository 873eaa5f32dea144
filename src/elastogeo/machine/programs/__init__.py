"""What a program tells a machine to do: blocks of motion that belong to no control, packed, and the path they make.

A wing: it imports only the files of this room.
"""
