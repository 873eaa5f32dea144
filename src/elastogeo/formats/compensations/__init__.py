"""Compensation files of controls, one file each: `compensation_files` has the contract and the recipe."""
