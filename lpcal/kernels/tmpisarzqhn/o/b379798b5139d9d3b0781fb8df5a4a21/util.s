.text
.balign 8
.globl logwtmp_2_2_5
.type logwtmp_2_2_5, %function
.symver logwtmp_2_2_5, logwtmp@@GLIBC_2.2.5, remove
logwtmp_2_2_5: .quad 0
.balign 8
.globl login_2_2_5
.type login_2_2_5, %function
.symver login_2_2_5, login@@GLIBC_2.2.5, remove
login_2_2_5: .quad 0
.balign 8
.globl forkpty_2_2_5
.type forkpty_2_2_5, %function
.symver forkpty_2_2_5, forkpty@@GLIBC_2.2.5, remove
forkpty_2_2_5: .quad 0
.balign 8
.globl openpty_2_2_5
.type openpty_2_2_5, %function
.symver openpty_2_2_5, openpty@@GLIBC_2.2.5, remove
openpty_2_2_5: .quad 0
.balign 8
.globl login_tty_2_2_5
.type login_tty_2_2_5, %function
.symver login_tty_2_2_5, login_tty@@GLIBC_2.2.5, remove
login_tty_2_2_5: .quad 0
.balign 8
.globl logout_2_2_5
.type logout_2_2_5, %function
.symver logout_2_2_5, logout@@GLIBC_2.2.5, remove
logout_2_2_5: .quad 0
.rodata
.data
