.text
.balign 8
.globl dladdr1_2_3_3
.type dladdr1_2_3_3, %function
.symver dladdr1_2_3_3, dladdr1@@GLIBC_2.3.3, remove
dladdr1_2_3_3: .quad 0
.balign 8
.globl dlinfo_2_3_3
.type dlinfo_2_3_3, %function
.symver dlinfo_2_3_3, dlinfo@@GLIBC_2.3.3, remove
dlinfo_2_3_3: .quad 0
.balign 8
.globl dlopen_2_2_5
.type dlopen_2_2_5, %function
.symver dlopen_2_2_5, dlopen@@GLIBC_2.2.5, remove
dlopen_2_2_5: .quad 0
.balign 8
.globl dlvsym_2_2_5
.type dlvsym_2_2_5, %function
.symver dlvsym_2_2_5, dlvsym@@GLIBC_2.2.5, remove
dlvsym_2_2_5: .quad 0
.balign 8
.globl dlmopen_2_3_4
.type dlmopen_2_3_4, %function
.symver dlmopen_2_3_4, dlmopen@@GLIBC_2.3.4, remove
dlmopen_2_3_4: .quad 0
.balign 8
.globl dladdr_2_2_5
.type dladdr_2_2_5, %function
.symver dladdr_2_2_5, dladdr@@GLIBC_2.2.5, remove
dladdr_2_2_5: .quad 0
.balign 8
.globl dlclose_2_2_5
.type dlclose_2_2_5, %function
.symver dlclose_2_2_5, dlclose@@GLIBC_2.2.5, remove
dlclose_2_2_5: .quad 0
.balign 8
.globl dlerror_2_2_5
.type dlerror_2_2_5, %function
.symver dlerror_2_2_5, dlerror@@GLIBC_2.2.5, remove
dlerror_2_2_5: .quad 0
.balign 8
.globl dlsym_2_2_5
.type dlsym_2_2_5, %function
.symver dlsym_2_2_5, dlsym@@GLIBC_2.2.5, remove
dlsym_2_2_5: .quad 0
.rodata
.data
