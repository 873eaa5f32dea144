"""What people write: machines, tests, feed drives, simulations, and templates of them, in TOML."""
