"""Feed drives: motor current -> torque -> force at the joint -> at the tool. Stands on `machine`, `estimate`, `errors`."""
