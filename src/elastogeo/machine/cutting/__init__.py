"""What loads the tool along its path: constant and measured forces, the milling model, and tool and holder that give way.

A wing: it imports only the files of this room.
"""
