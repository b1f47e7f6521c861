"""The camera in the tracked body: H_PC and H_OB of ``H_OP(t_k) H_PC H_CB,k = H_OB`` for views k of a static board.

`clock` finds the offset of the two clocks, `likelihood` is the maximum-likelihood problem, `variance` weighs its parts by their own
noise, `observability` tells what the motion can show, `solve` puts them together.
"""
