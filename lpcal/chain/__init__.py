"""One module a transform of the chain H_CL = (H_OP H_PC)^-1 H_OL; none imports another."""
