.text
.balign 8
.globl aio_return64_2_2_5
.type aio_return64_2_2_5, %function
.symver aio_return64_2_2_5, aio_return64@@GLIBC_2.2.5, remove
aio_return64_2_2_5: .quad 0
.balign 8
.globl lio_listio_2_4
.type lio_listio_2_4, %function
.symver lio_listio_2_4, lio_listio@@GLIBC_2.4, remove
lio_listio_2_4: .quad 0
.balign 8
.globl lio_listio_2_2_5
.type lio_listio_2_2_5, %function
.symver lio_listio_2_2_5, lio_listio@GLIBC_2.2.5, remove
lio_listio_2_2_5: .quad 0
.balign 8
.globl timer_getoverrun_2_2_5
.type timer_getoverrun_2_2_5, %function
.symver timer_getoverrun_2_2_5, timer_getoverrun@GLIBC_2.2.5, remove
timer_getoverrun_2_2_5: .quad 0
.balign 8
.globl timer_getoverrun_2_3_3
.type timer_getoverrun_2_3_3, %function
.symver timer_getoverrun_2_3_3, timer_getoverrun@@GLIBC_2.3.3, remove
timer_getoverrun_2_3_3: .quad 0
.balign 8
.globl aio_cancel64_2_2_5
.type aio_cancel64_2_2_5, %function
.symver aio_cancel64_2_2_5, aio_cancel64@@GLIBC_2.2.5, remove
aio_cancel64_2_2_5: .quad 0
.balign 8
.globl aio_fsync_2_2_5
.type aio_fsync_2_2_5, %function
.symver aio_fsync_2_2_5, aio_fsync@@GLIBC_2.2.5, remove
aio_fsync_2_2_5: .quad 0
.balign 8
.globl mq_getattr_2_3_4
.type mq_getattr_2_3_4, %function
.symver mq_getattr_2_3_4, mq_getattr@@GLIBC_2.3.4, remove
mq_getattr_2_3_4: .quad 0
.balign 8
.globl aio_read_2_2_5
.type aio_read_2_2_5, %function
.symver aio_read_2_2_5, aio_read@@GLIBC_2.2.5, remove
aio_read_2_2_5: .quad 0
.balign 8
.globl shm_open_2_2_5
.type shm_open_2_2_5, %function
.symver shm_open_2_2_5, shm_open@@GLIBC_2.2.5, remove
shm_open_2_2_5: .quad 0
.balign 8
.globl clock_getres_2_2_5
.type clock_getres_2_2_5, %function
.symver clock_getres_2_2_5, clock_getres@@GLIBC_2.2.5, remove
clock_getres_2_2_5: .quad 0
.balign 8
.globl mq_close_2_3_4
.type mq_close_2_3_4, %function
.symver mq_close_2_3_4, mq_close@@GLIBC_2.3.4, remove
mq_close_2_3_4: .quad 0
.balign 8
.globl shm_unlink_2_2_5
.type shm_unlink_2_2_5, %function
.symver shm_unlink_2_2_5, shm_unlink@@GLIBC_2.2.5, remove
shm_unlink_2_2_5: .quad 0
.balign 8
.globl mq_notify_2_3_4
.type mq_notify_2_3_4, %function
.symver mq_notify_2_3_4, mq_notify@@GLIBC_2.3.4, remove
mq_notify_2_3_4: .quad 0
.balign 8
.globl aio_read64_2_2_5
.type aio_read64_2_2_5, %function
.symver aio_read64_2_2_5, aio_read64@@GLIBC_2.2.5, remove
aio_read64_2_2_5: .quad 0
.balign 8
.globl mq_receive_2_3_4
.type mq_receive_2_3_4, %function
.symver mq_receive_2_3_4, mq_receive@@GLIBC_2.3.4, remove
mq_receive_2_3_4: .quad 0
.balign 8
.globl aio_suspend_2_2_5
.type aio_suspend_2_2_5, %function
.symver aio_suspend_2_2_5, aio_suspend@@GLIBC_2.2.5, remove
aio_suspend_2_2_5: .quad 0
.balign 8
.globl timer_delete_2_2_5
.type timer_delete_2_2_5, %function
.symver timer_delete_2_2_5, timer_delete@GLIBC_2.2.5, remove
timer_delete_2_2_5: .quad 0
.balign 8
.globl timer_delete_2_3_3
.type timer_delete_2_3_3, %function
.symver timer_delete_2_3_3, timer_delete@@GLIBC_2.3.3, remove
timer_delete_2_3_3: .quad 0
.balign 8
.globl aio_return_2_2_5
.type aio_return_2_2_5, %function
.symver aio_return_2_2_5, aio_return@@GLIBC_2.2.5, remove
aio_return_2_2_5: .quad 0
.balign 8
.globl lio_listio64_2_4
.type lio_listio64_2_4, %function
.symver lio_listio64_2_4, lio_listio64@@GLIBC_2.4, remove
lio_listio64_2_4: .quad 0
.balign 8
.globl lio_listio64_2_2_5
.type lio_listio64_2_2_5, %function
.symver lio_listio64_2_2_5, lio_listio64@GLIBC_2.2.5, remove
lio_listio64_2_2_5: .quad 0
.balign 8
.globl timer_gettime_2_2_5
.type timer_gettime_2_2_5, %function
.symver timer_gettime_2_2_5, timer_gettime@GLIBC_2.2.5, remove
timer_gettime_2_2_5: .quad 0
.balign 8
.globl timer_gettime_2_3_3
.type timer_gettime_2_3_3, %function
.symver timer_gettime_2_3_3, timer_gettime@@GLIBC_2.3.3, remove
timer_gettime_2_3_3: .quad 0
.balign 8
.globl clock_settime_2_2_5
.type clock_settime_2_2_5, %function
.symver clock_settime_2_2_5, clock_settime@@GLIBC_2.2.5, remove
clock_settime_2_2_5: .quad 0
.balign 8
.globl __mq_open_2_2_7
.type __mq_open_2_2_7, %function
.symver __mq_open_2_2_7, __mq_open_2@@GLIBC_2.7, remove
__mq_open_2_2_7: .quad 0
.balign 8
.globl aio_fsync64_2_2_5
.type aio_fsync64_2_2_5, %function
.symver aio_fsync64_2_2_5, aio_fsync64@@GLIBC_2.2.5, remove
aio_fsync64_2_2_5: .quad 0
.balign 8
.globl aio_write_2_2_5
.type aio_write_2_2_5, %function
.symver aio_write_2_2_5, aio_write@@GLIBC_2.2.5, remove
aio_write_2_2_5: .quad 0
.balign 8
.globl aio_suspend64_2_2_5
.type aio_suspend64_2_2_5, %function
.symver aio_suspend64_2_2_5, aio_suspend64@@GLIBC_2.2.5, remove
aio_suspend64_2_2_5: .quad 0
.balign 8
.globl clock_nanosleep_2_2_5
.type clock_nanosleep_2_2_5, %function
.symver clock_nanosleep_2_2_5, clock_nanosleep@@GLIBC_2.2.5, remove
clock_nanosleep_2_2_5: .quad 0
.balign 8
.globl mq_timedsend_2_3_4
.type mq_timedsend_2_3_4, %function
.symver mq_timedsend_2_3_4, mq_timedsend@@GLIBC_2.3.4, remove
mq_timedsend_2_3_4: .quad 0
.balign 8
.globl mq_send_2_3_4
.type mq_send_2_3_4, %function
.symver mq_send_2_3_4, mq_send@@GLIBC_2.3.4, remove
mq_send_2_3_4: .quad 0
.balign 8
.globl aio_error_2_2_5
.type aio_error_2_2_5, %function
.symver aio_error_2_2_5, aio_error@@GLIBC_2.2.5, remove
aio_error_2_2_5: .quad 0
.balign 8
.globl mq_setattr_2_3_4
.type mq_setattr_2_3_4, %function
.symver mq_setattr_2_3_4, mq_setattr@@GLIBC_2.3.4, remove
mq_setattr_2_3_4: .quad 0
.balign 8
.globl mq_unlink_2_3_4
.type mq_unlink_2_3_4, %function
.symver mq_unlink_2_3_4, mq_unlink@@GLIBC_2.3.4, remove
mq_unlink_2_3_4: .quad 0
.balign 8
.globl aio_write64_2_2_5
.type aio_write64_2_2_5, %function
.symver aio_write64_2_2_5, aio_write64@@GLIBC_2.2.5, remove
aio_write64_2_2_5: .quad 0
.balign 8
.globl aio_init_2_2_5
.type aio_init_2_2_5, %function
.symver aio_init_2_2_5, aio_init@@GLIBC_2.2.5, remove
aio_init_2_2_5: .quad 0
.balign 8
.globl mq_timedreceive_2_3_4
.type mq_timedreceive_2_3_4, %function
.symver mq_timedreceive_2_3_4, mq_timedreceive@@GLIBC_2.3.4, remove
mq_timedreceive_2_3_4: .quad 0
.balign 8
.globl aio_cancel_2_2_5
.type aio_cancel_2_2_5, %function
.symver aio_cancel_2_2_5, aio_cancel@@GLIBC_2.2.5, remove
aio_cancel_2_2_5: .quad 0
.balign 8
.globl clock_gettime_2_2_5
.type clock_gettime_2_2_5, %function
.symver clock_gettime_2_2_5, clock_gettime@@GLIBC_2.2.5, remove
clock_gettime_2_2_5: .quad 0
.balign 8
.globl timer_settime_2_2_5
.type timer_settime_2_2_5, %function
.symver timer_settime_2_2_5, timer_settime@GLIBC_2.2.5, remove
timer_settime_2_2_5: .quad 0
.balign 8
.globl timer_settime_2_3_3
.type timer_settime_2_3_3, %function
.symver timer_settime_2_3_3, timer_settime@@GLIBC_2.3.3, remove
timer_settime_2_3_3: .quad 0
.balign 8
.globl mq_open_2_3_4
.type mq_open_2_3_4, %function
.symver mq_open_2_3_4, mq_open@@GLIBC_2.3.4, remove
mq_open_2_3_4: .quad 0
.balign 8
.globl clock_getcpuclockid_2_2_5
.type clock_getcpuclockid_2_2_5, %function
.symver clock_getcpuclockid_2_2_5, clock_getcpuclockid@@GLIBC_2.2.5, remove
clock_getcpuclockid_2_2_5: .quad 0
.balign 8
.globl timer_create_2_2_5
.type timer_create_2_2_5, %function
.symver timer_create_2_2_5, timer_create@GLIBC_2.2.5, remove
timer_create_2_2_5: .quad 0
.balign 8
.globl timer_create_2_3_3
.type timer_create_2_3_3, %function
.symver timer_create_2_3_3, timer_create@@GLIBC_2.3.3, remove
timer_create_2_3_3: .quad 0
.balign 8
.globl aio_error64_2_2_5
.type aio_error64_2_2_5, %function
.symver aio_error64_2_2_5, aio_error64@@GLIBC_2.2.5, remove
aio_error64_2_2_5: .quad 0
.rodata
.data
