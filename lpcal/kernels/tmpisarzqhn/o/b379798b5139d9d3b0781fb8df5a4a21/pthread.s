.text
.balign 8
.globl pthread_mutexattr_init_2_2_5
.type pthread_mutexattr_init_2_2_5, %function
.symver pthread_mutexattr_init_2_2_5, pthread_mutexattr_init@@GLIBC_2.2.5, remove
pthread_mutexattr_init_2_2_5: .quad 0
.balign 8
.globl fcntl_2_2_5
.type fcntl_2_2_5, %function
.symver fcntl_2_2_5, fcntl@@GLIBC_2.2.5, remove
fcntl_2_2_5: .quad 0
.balign 8
.globl recvmsg_2_2_5
.type recvmsg_2_2_5, %function
.symver recvmsg_2_2_5, recvmsg@@GLIBC_2.2.5, remove
recvmsg_2_2_5: .quad 0
.balign 8
.globl fsync_2_2_5
.type fsync_2_2_5, %function
.symver fsync_2_2_5, fsync@@GLIBC_2.2.5, remove
fsync_2_2_5: .quad 0
.balign 8
.globl __pthread_getspecific_2_2_5
.type __pthread_getspecific_2_2_5, %function
.symver __pthread_getspecific_2_2_5, __pthread_getspecific@@GLIBC_2.2.5, remove
__pthread_getspecific_2_2_5: .quad 0
.balign 8
.globl __pthread_rwlock_unlock_2_2_5
.type __pthread_rwlock_unlock_2_2_5, %function
.symver __pthread_rwlock_unlock_2_2_5, __pthread_rwlock_unlock@@GLIBC_2.2.5, remove
__pthread_rwlock_unlock_2_2_5: .quad 0
.balign 8
.globl __res_state_2_2_5
.type __res_state_2_2_5, %function
.symver __res_state_2_2_5, __res_state@@GLIBC_2.2.5, remove
__res_state_2_2_5: .quad 0
.balign 8
.globl pthread_rwlock_timedwrlock_2_2_5
.type pthread_rwlock_timedwrlock_2_2_5, %function
.symver pthread_rwlock_timedwrlock_2_2_5, pthread_rwlock_timedwrlock@@GLIBC_2.2.5, remove
pthread_rwlock_timedwrlock_2_2_5: .quad 0
.balign 8
.globl pthread_cond_destroy_2_2_5
.type pthread_cond_destroy_2_2_5, %function
.symver pthread_cond_destroy_2_2_5, pthread_cond_destroy@GLIBC_2.2.5, remove
pthread_cond_destroy_2_2_5: .quad 0
.balign 8
.globl pthread_cond_destroy_2_3_2
.type pthread_cond_destroy_2_3_2, %function
.symver pthread_cond_destroy_2_3_2, pthread_cond_destroy@@GLIBC_2.3.2, remove
pthread_cond_destroy_2_3_2: .quad 0
.balign 8
.globl pthread_rwlock_unlock_2_2_5
.type pthread_rwlock_unlock_2_2_5, %function
.symver pthread_rwlock_unlock_2_2_5, pthread_rwlock_unlock@@GLIBC_2.2.5, remove
pthread_rwlock_unlock_2_2_5: .quad 0
.balign 8
.globl __read_2_2_5
.type __read_2_2_5, %function
.symver __read_2_2_5, __read@@GLIBC_2.2.5, remove
__read_2_2_5: .quad 0
.balign 8
.globl sigaction_2_2_5
.type sigaction_2_2_5, %function
.symver sigaction_2_2_5, sigaction@@GLIBC_2.2.5, remove
sigaction_2_2_5: .quad 0
.balign 8
.globl pthread_mutex_getprioceiling_2_4
.type pthread_mutex_getprioceiling_2_4, %function
.symver pthread_mutex_getprioceiling_2_4, pthread_mutex_getprioceiling@@GLIBC_2.4, remove
pthread_mutex_getprioceiling_2_4: .quad 0
.balign 8
.globl pthread_getaffinity_np_2_3_3
.type pthread_getaffinity_np_2_3_3, %function
.symver pthread_getaffinity_np_2_3_3, pthread_getaffinity_np@GLIBC_2.3.3, remove
pthread_getaffinity_np_2_3_3: .quad 0
.balign 8
.globl pthread_getaffinity_np_2_3_4
.type pthread_getaffinity_np_2_3_4, %function
.symver pthread_getaffinity_np_2_3_4, pthread_getaffinity_np@@GLIBC_2.3.4, remove
pthread_getaffinity_np_2_3_4: .quad 0
.balign 8
.globl pthread_sigqueue_2_11
.type pthread_sigqueue_2_11, %function
.symver pthread_sigqueue_2_11, pthread_sigqueue@@GLIBC_2.11, remove
pthread_sigqueue_2_11: .quad 0
.balign 8
.globl sem_open_2_2_5
.type sem_open_2_2_5, %function
.symver sem_open_2_2_5, sem_open@@GLIBC_2.2.5, remove
sem_open_2_2_5: .quad 0
.balign 8
.globl sem_wait_2_2_5
.type sem_wait_2_2_5, %function
.symver sem_wait_2_2_5, sem_wait@@GLIBC_2.2.5, remove
sem_wait_2_2_5: .quad 0
.balign 8
.globl pthread_mutexattr_setprotocol_2_4
.type pthread_mutexattr_setprotocol_2_4, %function
.symver pthread_mutexattr_setprotocol_2_4, pthread_mutexattr_setprotocol@@GLIBC_2.4, remove
pthread_mutexattr_setprotocol_2_4: .quad 0
.balign 8
.globl pthread_mutexattr_getrobust_np_2_4
.type pthread_mutexattr_getrobust_np_2_4, %function
.symver pthread_mutexattr_getrobust_np_2_4, pthread_mutexattr_getrobust_np@@GLIBC_2.4, remove
pthread_mutexattr_getrobust_np_2_4: .quad 0
.balign 8
.globl __fork_2_2_5
.type __fork_2_2_5, %function
.symver __fork_2_2_5, __fork@@GLIBC_2.2.5, remove
__fork_2_2_5: .quad 0
.balign 8
.globl __pthread_unregister_cancel_2_3_3
.type __pthread_unregister_cancel_2_3_3, %function
.symver __pthread_unregister_cancel_2_3_3, __pthread_unregister_cancel@@GLIBC_2.3.3, remove
__pthread_unregister_cancel_2_3_3: .quad 0
.balign 8
.globl __send_2_2_5
.type __send_2_2_5, %function
.symver __send_2_2_5, __send@@GLIBC_2.2.5, remove
__send_2_2_5: .quad 0
.balign 8
.globl recvfrom_2_2_5
.type recvfrom_2_2_5, %function
.symver recvfrom_2_2_5, recvfrom@@GLIBC_2.2.5, remove
recvfrom_2_2_5: .quad 0
.balign 8
.globl pthread_attr_init_2_2_5
.type pthread_attr_init_2_2_5, %function
.symver pthread_attr_init_2_2_5, pthread_attr_init@@GLIBC_2.2.5, remove
pthread_attr_init_2_2_5: .quad 0
.balign 8
.globl wait_2_2_5
.type wait_2_2_5, %function
.symver wait_2_2_5, wait@@GLIBC_2.2.5, remove
wait_2_2_5: .quad 0
.balign 8
.globl pthread_condattr_setclock_2_3_3
.type pthread_condattr_setclock_2_3_3, %function
.symver pthread_condattr_setclock_2_3_3, pthread_condattr_setclock@@GLIBC_2.3.3, remove
pthread_condattr_setclock_2_3_3: .quad 0
.balign 8
.globl pthread_condattr_getpshared_2_2_5
.type pthread_condattr_getpshared_2_2_5, %function
.symver pthread_condattr_getpshared_2_2_5, pthread_condattr_getpshared@@GLIBC_2.2.5, remove
pthread_condattr_getpshared_2_2_5: .quad 0
.balign 8
.globl __pthread_unwind_next_2_3_3
.type __pthread_unwind_next_2_3_3, %function
.symver __pthread_unwind_next_2_3_3, __pthread_unwind_next@@GLIBC_2.3.3, remove
__pthread_unwind_next_2_3_3: .quad 0
.balign 8
.globl pthread_mutexattr_settype_2_2_5
.type pthread_mutexattr_settype_2_2_5, %function
.symver pthread_mutexattr_settype_2_2_5, pthread_mutexattr_settype@@GLIBC_2.2.5, remove
pthread_mutexattr_settype_2_2_5: .quad 0
.balign 8
.globl pthread_attr_setaffinity_np_2_3_3
.type pthread_attr_setaffinity_np_2_3_3, %function
.symver pthread_attr_setaffinity_np_2_3_3, pthread_attr_setaffinity_np@GLIBC_2.3.3, remove
pthread_attr_setaffinity_np_2_3_3: .quad 0
.balign 8
.globl pthread_attr_setaffinity_np_2_3_4
.type pthread_attr_setaffinity_np_2_3_4, %function
.symver pthread_attr_setaffinity_np_2_3_4, pthread_attr_setaffinity_np@@GLIBC_2.3.4, remove
pthread_attr_setaffinity_np_2_3_4: .quad 0
.balign 8
.globl _pthread_cleanup_push_defer_2_2_5
.type _pthread_cleanup_push_defer_2_2_5, %function
.symver _pthread_cleanup_push_defer_2_2_5, _pthread_cleanup_push_defer@@GLIBC_2.2.5, remove
_pthread_cleanup_push_defer_2_2_5: .quad 0
.balign 8
.globl pthread_rwlockattr_setkind_np_2_2_5
.type pthread_rwlockattr_setkind_np_2_2_5, %function
.symver pthread_rwlockattr_setkind_np_2_2_5, pthread_rwlockattr_setkind_np@@GLIBC_2.2.5, remove
pthread_rwlockattr_setkind_np_2_2_5: .quad 0
.balign 8
.globl sem_destroy_2_2_5
.type sem_destroy_2_2_5, %function
.symver sem_destroy_2_2_5, sem_destroy@@GLIBC_2.2.5, remove
sem_destroy_2_2_5: .quad 0
.balign 8
.globl __pthread_register_cancel_defer_2_3_3
.type __pthread_register_cancel_defer_2_3_3, %function
.symver __pthread_register_cancel_defer_2_3_3, __pthread_register_cancel_defer@@GLIBC_2.3.3, remove
__pthread_register_cancel_defer_2_3_3: .quad 0
.balign 8
.globl pthread_condattr_getclock_2_3_3
.type pthread_condattr_getclock_2_3_3, %function
.symver pthread_condattr_getclock_2_3_3, pthread_condattr_getclock@@GLIBC_2.3.3, remove
pthread_condattr_getclock_2_3_3: .quad 0
.balign 8
.globl __pthread_rwlock_trywrlock_2_2_5
.type __pthread_rwlock_trywrlock_2_2_5, %function
.symver __pthread_rwlock_trywrlock_2_2_5, __pthread_rwlock_trywrlock@@GLIBC_2.2.5, remove
__pthread_rwlock_trywrlock_2_2_5: .quad 0
.balign 8
.globl msync_2_2_5
.type msync_2_2_5, %function
.symver msync_2_2_5, msync@@GLIBC_2.2.5, remove
msync_2_2_5: .quad 0
.balign 8
.globl __pthread_register_cancel_2_3_3
.type __pthread_register_cancel_2_3_3, %function
.symver __pthread_register_cancel_2_3_3, __pthread_register_cancel@@GLIBC_2.3.3, remove
__pthread_register_cancel_2_3_3: .quad 0
.balign 8
.globl pthread_attr_setstack_2_2_5
.type pthread_attr_setstack_2_2_5, %function
.symver pthread_attr_setstack_2_2_5, pthread_attr_setstack@@GLIBC_2.2.5, remove
pthread_attr_setstack_2_2_5: .quad 0
.balign 8
.globl _IO_funlockfile_2_2_5
.type _IO_funlockfile_2_2_5, %function
.symver _IO_funlockfile_2_2_5, _IO_funlockfile@@GLIBC_2.2.5, remove
_IO_funlockfile_2_2_5: .quad 0
.balign 8
.globl pthread_cond_broadcast_2_2_5
.type pthread_cond_broadcast_2_2_5, %function
.symver pthread_cond_broadcast_2_2_5, pthread_cond_broadcast@GLIBC_2.2.5, remove
pthread_cond_broadcast_2_2_5: .quad 0
.balign 8
.globl pthread_cond_broadcast_2_3_2
.type pthread_cond_broadcast_2_3_2, %function
.symver pthread_cond_broadcast_2_3_2, pthread_cond_broadcast@@GLIBC_2.3.2, remove
pthread_cond_broadcast_2_3_2: .quad 0
.balign 8
.globl pthread_attr_setstacksize_2_2_5
.type pthread_attr_setstacksize_2_2_5, %function
.symver pthread_attr_setstacksize_2_2_5, pthread_attr_setstacksize@@GLIBC_2.2.5, remove
pthread_attr_setstacksize_2_2_5: .quad 0
.balign 8
.globl pthread_self_2_2_5
.type pthread_self_2_2_5, %function
.symver pthread_self_2_2_5, pthread_self@@GLIBC_2.2.5, remove
pthread_self_2_2_5: .quad 0
.balign 8
.globl pwrite64_2_2_5
.type pwrite64_2_2_5, %function
.symver pwrite64_2_2_5, pwrite64@@GLIBC_2.2.5, remove
pwrite64_2_2_5: .quad 0
.balign 8
.globl vfork_2_2_5
.type vfork_2_2_5, %function
.symver vfork_2_2_5, vfork@@GLIBC_2.2.5, remove
vfork_2_2_5: .quad 0
.balign 8
.globl pthread_attr_getstacksize_2_2_5
.type pthread_attr_getstacksize_2_2_5, %function
.symver pthread_attr_getstacksize_2_2_5, pthread_attr_getstacksize@@GLIBC_2.2.5, remove
pthread_attr_getstacksize_2_2_5: .quad 0
.balign 8
.globl pthread_mutexattr_setprioceiling_2_4
.type pthread_mutexattr_setprioceiling_2_4, %function
.symver pthread_mutexattr_setprioceiling_2_4, pthread_mutexattr_setprioceiling@@GLIBC_2.4, remove
pthread_mutexattr_setprioceiling_2_4: .quad 0
.balign 8
.globl fork_2_2_5
.type fork_2_2_5, %function
.symver fork_2_2_5, fork@@GLIBC_2.2.5, remove
fork_2_2_5: .quad 0
.balign 8
.globl pthread_setname_np_2_12
.type pthread_setname_np_2_12, %function
.symver pthread_setname_np_2_12, pthread_setname_np@@GLIBC_2.12, remove
pthread_setname_np_2_12: .quad 0
.balign 8
.globl pthread_condattr_setpshared_2_2_5
.type pthread_condattr_setpshared_2_2_5, %function
.symver pthread_condattr_setpshared_2_2_5, pthread_condattr_setpshared@@GLIBC_2.2.5, remove
pthread_condattr_setpshared_2_2_5: .quad 0
.balign 8
.globl pthread_mutexattr_gettype_2_2_5
.type pthread_mutexattr_gettype_2_2_5, %function
.symver pthread_mutexattr_gettype_2_2_5, pthread_mutexattr_gettype@@GLIBC_2.2.5, remove
pthread_mutexattr_gettype_2_2_5: .quad 0
.balign 8
.globl __pthread_mutex_lock_2_2_5
.type __pthread_mutex_lock_2_2_5, %function
.symver __pthread_mutex_lock_2_2_5, __pthread_mutex_lock@@GLIBC_2.2.5, remove
__pthread_mutex_lock_2_2_5: .quad 0
.balign 8
.globl pthread_attr_setdetachstate_2_2_5
.type pthread_attr_setdetachstate_2_2_5, %function
.symver pthread_attr_setdetachstate_2_2_5, pthread_attr_setdetachstate@@GLIBC_2.2.5, remove
pthread_attr_setdetachstate_2_2_5: .quad 0
.balign 8
.globl pthread_rwlock_init_2_2_5
.type pthread_rwlock_init_2_2_5, %function
.symver pthread_rwlock_init_2_2_5, pthread_rwlock_init@@GLIBC_2.2.5, remove
pthread_rwlock_init_2_2_5: .quad 0
.balign 8
.globl sem_post_2_2_5
.type sem_post_2_2_5, %function
.symver sem_post_2_2_5, sem_post@@GLIBC_2.2.5, remove
sem_post_2_2_5: .quad 0
.balign 8
.globl __pthread_once_2_2_5
.type __pthread_once_2_2_5, %function
.symver __pthread_once_2_2_5, __pthread_once@@GLIBC_2.2.5, remove
__pthread_once_2_2_5: .quad 0
.balign 8
.globl _pthread_cleanup_pop_restore_2_2_5
.type _pthread_cleanup_pop_restore_2_2_5, %function
.symver _pthread_cleanup_pop_restore_2_2_5, _pthread_cleanup_pop_restore@@GLIBC_2.2.5, remove
_pthread_cleanup_pop_restore_2_2_5: .quad 0
.balign 8
.globl connect_2_2_5
.type connect_2_2_5, %function
.symver connect_2_2_5, connect@@GLIBC_2.2.5, remove
connect_2_2_5: .quad 0
.balign 8
.globl pthread_cond_init_2_2_5
.type pthread_cond_init_2_2_5, %function
.symver pthread_cond_init_2_2_5, pthread_cond_init@GLIBC_2.2.5, remove
pthread_cond_init_2_2_5: .quad 0
.balign 8
.globl pthread_cond_init_2_3_2
.type pthread_cond_init_2_3_2, %function
.symver pthread_cond_init_2_3_2, pthread_cond_init@@GLIBC_2.3.2, remove
pthread_cond_init_2_3_2: .quad 0
.balign 8
.globl pthread_setcancelstate_2_2_5
.type pthread_setcancelstate_2_2_5, %function
.symver pthread_setcancelstate_2_2_5, pthread_setcancelstate@@GLIBC_2.2.5, remove
pthread_setcancelstate_2_2_5: .quad 0
.balign 8
.globl __pthread_unregister_cancel_restore_2_3_3
.type __pthread_unregister_cancel_restore_2_3_3, %function
.symver __pthread_unregister_cancel_restore_2_3_3, __pthread_unregister_cancel_restore@@GLIBC_2.3.3, remove
__pthread_unregister_cancel_restore_2_3_3: .quad 0
.balign 8
.globl pthread_mutexattr_getkind_np_2_2_5
.type pthread_mutexattr_getkind_np_2_2_5, %function
.symver pthread_mutexattr_getkind_np_2_2_5, pthread_mutexattr_getkind_np@@GLIBC_2.2.5, remove
pthread_mutexattr_getkind_np_2_2_5: .quad 0
.balign 8
.globl nanosleep_2_2_5
.type nanosleep_2_2_5, %function
.symver nanosleep_2_2_5, nanosleep@@GLIBC_2.2.5, remove
nanosleep_2_2_5: .quad 0
.balign 8
.globl pthread_barrierattr_destroy_2_2_5
.type pthread_barrierattr_destroy_2_2_5, %function
.symver pthread_barrierattr_destroy_2_2_5, pthread_barrierattr_destroy@@GLIBC_2.2.5, remove
pthread_barrierattr_destroy_2_2_5: .quad 0
.balign 8
.globl __pthread_rwlock_tryrdlock_2_2_5
.type __pthread_rwlock_tryrdlock_2_2_5, %function
.symver __pthread_rwlock_tryrdlock_2_2_5, __pthread_rwlock_tryrdlock@@GLIBC_2.2.5, remove
__pthread_rwlock_tryrdlock_2_2_5: .quad 0
.balign 8
.globl pthread_mutexattr_getrobust_2_12
.type pthread_mutexattr_getrobust_2_12, %function
.symver pthread_mutexattr_getrobust_2_12, pthread_mutexattr_getrobust@@GLIBC_2.12, remove
pthread_mutexattr_getrobust_2_12: .quad 0
.balign 8
.globl pthread_attr_setschedparam_2_2_5
.type pthread_attr_setschedparam_2_2_5, %function
.symver pthread_attr_setschedparam_2_2_5, pthread_attr_setschedparam@@GLIBC_2.2.5, remove
pthread_attr_setschedparam_2_2_5: .quad 0
.balign 8
.globl pthread_attr_setschedpolicy_2_2_5
.type pthread_attr_setschedpolicy_2_2_5, %function
.symver pthread_attr_setschedpolicy_2_2_5, pthread_attr_setschedpolicy@@GLIBC_2.2.5, remove
pthread_attr_setschedpolicy_2_2_5: .quad 0
.balign 8
.globl pthread_attr_setguardsize_2_2_5
.type pthread_attr_setguardsize_2_2_5, %function
.symver pthread_attr_setguardsize_2_2_5, pthread_attr_setguardsize@@GLIBC_2.2.5, remove
pthread_attr_setguardsize_2_2_5: .quad 0
.balign 8
.globl pwrite_2_2_5
.type pwrite_2_2_5, %function
.symver pwrite_2_2_5, pwrite@@GLIBC_2.2.5, remove
pwrite_2_2_5: .quad 0
.balign 8
.globl pthread_getschedparam_2_2_5
.type pthread_getschedparam_2_2_5, %function
.symver pthread_getschedparam_2_2_5, pthread_getschedparam@@GLIBC_2.2.5, remove
pthread_getschedparam_2_2_5: .quad 0
.balign 8
.globl pthread_mutexattr_setkind_np_2_2_5
.type pthread_mutexattr_setkind_np_2_2_5, %function
.symver pthread_mutexattr_setkind_np_2_2_5, pthread_mutexattr_setkind_np@@GLIBC_2.2.5, remove
pthread_mutexattr_setkind_np_2_2_5: .quad 0
.balign 8
.globl pread64_2_2_5
.type pread64_2_2_5, %function
.symver pread64_2_2_5, pread64@@GLIBC_2.2.5, remove
pread64_2_2_5: .quad 0
.balign 8
.globl _IO_ftrylockfile_2_2_5
.type _IO_ftrylockfile_2_2_5, %function
.symver _IO_ftrylockfile_2_2_5, _IO_ftrylockfile@@GLIBC_2.2.5, remove
_IO_ftrylockfile_2_2_5: .quad 0
.balign 8
.globl __pthread_mutex_unlock_2_2_5
.type __pthread_mutex_unlock_2_2_5, %function
.symver __pthread_mutex_unlock_2_2_5, __pthread_mutex_unlock@@GLIBC_2.2.5, remove
__pthread_mutex_unlock_2_2_5: .quad 0
.balign 8
.globl pthread_barrier_wait_2_2_5
.type pthread_barrier_wait_2_2_5, %function
.symver pthread_barrier_wait_2_2_5, pthread_barrier_wait@@GLIBC_2.2.5, remove
pthread_barrier_wait_2_2_5: .quad 0
.balign 8
.globl pthread_create_2_2_5
.type pthread_create_2_2_5, %function
.symver pthread_create_2_2_5, pthread_create@@GLIBC_2.2.5, remove
pthread_create_2_2_5: .quad 0
.balign 8
.globl pthread_mutexattr_getprioceiling_2_4
.type pthread_mutexattr_getprioceiling_2_4, %function
.symver pthread_mutexattr_getprioceiling_2_4, pthread_mutexattr_getprioceiling@@GLIBC_2.4, remove
pthread_mutexattr_getprioceiling_2_4: .quad 0
.balign 8
.globl pthread_attr_getstackaddr_2_2_5
.type pthread_attr_getstackaddr_2_2_5, %function
.symver pthread_attr_getstackaddr_2_2_5, pthread_attr_getstackaddr@@GLIBC_2.2.5, remove
pthread_attr_getstackaddr_2_2_5: .quad 0
.balign 8
.globl __h_errno_location_2_2_5
.type __h_errno_location_2_2_5, %function
.symver __h_errno_location_2_2_5, __h_errno_location@@GLIBC_2.2.5, remove
__h_errno_location_2_2_5: .quad 0
.balign 8
.globl pthread_detach_2_2_5
.type pthread_detach_2_2_5, %function
.symver pthread_detach_2_2_5, pthread_detach@@GLIBC_2.2.5, remove
pthread_detach_2_2_5: .quad 0
.balign 8
.globl pthread_attr_getscope_2_2_5
.type pthread_attr_getscope_2_2_5, %function
.symver pthread_attr_getscope_2_2_5, pthread_attr_getscope@@GLIBC_2.2.5, remove
pthread_attr_getscope_2_2_5: .quad 0
.balign 8
.globl pthread_getconcurrency_2_2_5
.type pthread_getconcurrency_2_2_5, %function
.symver pthread_getconcurrency_2_2_5, pthread_getconcurrency@@GLIBC_2.2.5, remove
pthread_getconcurrency_2_2_5: .quad 0
.balign 8
.globl __write_2_2_5
.type __write_2_2_5, %function
.symver __write_2_2_5, __write@@GLIBC_2.2.5, remove
__write_2_2_5: .quad 0
.balign 8
.globl __libc_current_sigrtmax_2_2_5
.type __libc_current_sigrtmax_2_2_5, %function
.symver __libc_current_sigrtmax_2_2_5, __libc_current_sigrtmax@@GLIBC_2.2.5, remove
__libc_current_sigrtmax_2_2_5: .quad 0
.balign 8
.globl pthread_mutex_consistent_np_2_4
.type pthread_mutex_consistent_np_2_4, %function
.symver pthread_mutex_consistent_np_2_4, pthread_mutex_consistent_np@@GLIBC_2.4, remove
pthread_mutex_consistent_np_2_4: .quad 0
.balign 8
.globl sendmsg_2_2_5
.type sendmsg_2_2_5, %function
.symver sendmsg_2_2_5, sendmsg@@GLIBC_2.2.5, remove
sendmsg_2_2_5: .quad 0
.balign 8
.globl pthread_getcpuclockid_2_2_5
.type pthread_getcpuclockid_2_2_5, %function
.symver pthread_getcpuclockid_2_2_5, pthread_getcpuclockid@@GLIBC_2.2.5, remove
pthread_getcpuclockid_2_2_5: .quad 0
.balign 8
.globl _IO_flockfile_2_2_5
.type _IO_flockfile_2_2_5, %function
.symver _IO_flockfile_2_2_5, _IO_flockfile@@GLIBC_2.2.5, remove
_IO_flockfile_2_2_5: .quad 0
.balign 8
.globl pthread_attr_setinheritsched_2_2_5
.type pthread_attr_setinheritsched_2_2_5, %function
.symver pthread_attr_setinheritsched_2_2_5, pthread_attr_setinheritsched@@GLIBC_2.2.5, remove
pthread_attr_setinheritsched_2_2_5: .quad 0
.balign 8
.globl __pthread_cleanup_routine_2_3_3
.type __pthread_cleanup_routine_2_3_3, %function
.symver __pthread_cleanup_routine_2_3_3, __pthread_cleanup_routine@@GLIBC_2.3.3, remove
__pthread_cleanup_routine_2_3_3: .quad 0
.balign 8
.globl pthread_mutex_init_2_2_5
.type pthread_mutex_init_2_2_5, %function
.symver pthread_mutex_init_2_2_5, pthread_mutex_init@@GLIBC_2.2.5, remove
pthread_mutex_init_2_2_5: .quad 0
.balign 8
.globl __pthread_rwlock_rdlock_2_2_5
.type __pthread_rwlock_rdlock_2_2_5, %function
.symver __pthread_rwlock_rdlock_2_2_5, __pthread_rwlock_rdlock@@GLIBC_2.2.5, remove
__pthread_rwlock_rdlock_2_2_5: .quad 0
.balign 8
.globl pthread_rwlockattr_getkind_np_2_2_5
.type pthread_rwlockattr_getkind_np_2_2_5, %function
.symver pthread_rwlockattr_getkind_np_2_2_5, pthread_rwlockattr_getkind_np@@GLIBC_2.2.5, remove
pthread_rwlockattr_getkind_np_2_2_5: .quad 0
.balign 8
.globl pthread_equal_2_2_5
.type pthread_equal_2_2_5, %function
.symver pthread_equal_2_2_5, pthread_equal@@GLIBC_2.2.5, remove
pthread_equal_2_2_5: .quad 0
.balign 8
.globl pthread_mutex_trylock_2_2_5
.type pthread_mutex_trylock_2_2_5, %function
.symver pthread_mutex_trylock_2_2_5, pthread_mutex_trylock@@GLIBC_2.2.5, remove
pthread_mutex_trylock_2_2_5: .quad 0
.balign 8
.globl pthread_spin_trylock_2_2_5
.type pthread_spin_trylock_2_2_5, %function
.symver pthread_spin_trylock_2_2_5, pthread_spin_trylock@@GLIBC_2.2.5, remove
pthread_spin_trylock_2_2_5: .quad 0
.balign 8
.globl pthread_mutexattr_destroy_2_2_5
.type pthread_mutexattr_destroy_2_2_5, %function
.symver pthread_mutexattr_destroy_2_2_5, pthread_mutexattr_destroy@@GLIBC_2.2.5, remove
pthread_mutexattr_destroy_2_2_5: .quad 0
.balign 8
.globl pthread_spin_destroy_2_2_5
.type pthread_spin_destroy_2_2_5, %function
.symver pthread_spin_destroy_2_2_5, pthread_spin_destroy@@GLIBC_2.2.5, remove
pthread_spin_destroy_2_2_5: .quad 0
.balign 8
.globl pthread_mutex_destroy_2_2_5
.type pthread_mutex_destroy_2_2_5, %function
.symver pthread_mutex_destroy_2_2_5, pthread_mutex_destroy@@GLIBC_2.2.5, remove
pthread_mutex_destroy_2_2_5: .quad 0
.balign 8
.globl __connect_2_2_5
.type __connect_2_2_5, %function
.symver __connect_2_2_5, __connect@@GLIBC_2.2.5, remove
__connect_2_2_5: .quad 0
.balign 8
.globl pthread_setschedprio_2_3_4
.type pthread_setschedprio_2_3_4, %function
.symver pthread_setschedprio_2_3_4, pthread_setschedprio@@GLIBC_2.3.4, remove
pthread_setschedprio_2_3_4: .quad 0
.balign 8
.globl longjmp_2_2_5
.type longjmp_2_2_5, %function
.symver longjmp_2_2_5, longjmp@@GLIBC_2.2.5, remove
longjmp_2_2_5: .quad 0
.balign 8
.globl pthread_spin_init_2_2_5
.type pthread_spin_init_2_2_5, %function
.symver pthread_spin_init_2_2_5, pthread_spin_init@@GLIBC_2.2.5, remove
pthread_spin_init_2_2_5: .quad 0
.balign 8
.globl __sigaction_2_2_5
.type __sigaction_2_2_5, %function
.symver __sigaction_2_2_5, __sigaction@@GLIBC_2.2.5, remove
__sigaction_2_2_5: .quad 0
.balign 8
.globl sem_trywait_2_2_5
.type sem_trywait_2_2_5, %function
.symver sem_trywait_2_2_5, sem_trywait@@GLIBC_2.2.5, remove
sem_trywait_2_2_5: .quad 0
.balign 8
.globl __open64_2_2_5
.type __open64_2_2_5, %function
.symver __open64_2_2_5, __open64@@GLIBC_2.2.5, remove
__open64_2_2_5: .quad 0
.balign 8
.globl pthread_mutexattr_setrobust_np_2_4
.type pthread_mutexattr_setrobust_np_2_4, %function
.symver pthread_mutexattr_setrobust_np_2_4, pthread_mutexattr_setrobust_np@@GLIBC_2.4, remove
pthread_mutexattr_setrobust_np_2_4: .quad 0
.balign 8
.globl pthread_mutexattr_getpshared_2_2_5
.type pthread_mutexattr_getpshared_2_2_5, %function
.symver pthread_mutexattr_getpshared_2_2_5, pthread_mutexattr_getpshared@@GLIBC_2.2.5, remove
pthread_mutexattr_getpshared_2_2_5: .quad 0
.balign 8
.globl pause_2_2_5
.type pause_2_2_5, %function
.symver pause_2_2_5, pause@@GLIBC_2.2.5, remove
pause_2_2_5: .quad 0
.balign 8
.globl open64_2_2_5
.type open64_2_2_5, %function
.symver open64_2_2_5, open64@@GLIBC_2.2.5, remove
open64_2_2_5: .quad 0
.balign 8
.globl pthread_mutexattr_setrobust_2_12
.type pthread_mutexattr_setrobust_2_12, %function
.symver pthread_mutexattr_setrobust_2_12, pthread_mutexattr_setrobust@@GLIBC_2.12, remove
pthread_mutexattr_setrobust_2_12: .quad 0
.balign 8
.globl pthread_rwlock_wrlock_2_2_5
.type pthread_rwlock_wrlock_2_2_5, %function
.symver pthread_rwlock_wrlock_2_2_5, pthread_rwlock_wrlock@@GLIBC_2.2.5, remove
pthread_rwlock_wrlock_2_2_5: .quad 0
.balign 8
.globl sem_getvalue_2_2_5
.type sem_getvalue_2_2_5, %function
.symver sem_getvalue_2_2_5, sem_getvalue@@GLIBC_2.2.5, remove
sem_getvalue_2_2_5: .quad 0
.balign 8
.globl funlockfile_2_2_5
.type funlockfile_2_2_5, %function
.symver funlockfile_2_2_5, funlockfile@@GLIBC_2.2.5, remove
funlockfile_2_2_5: .quad 0
.balign 8
.globl __pwrite64_2_2_5
.type __pwrite64_2_2_5, %function
.symver __pwrite64_2_2_5, __pwrite64@@GLIBC_2.2.5, remove
__pwrite64_2_2_5: .quad 0
.balign 8
.globl pthread_mutexattr_setpshared_2_2_5
.type pthread_mutexattr_setpshared_2_2_5, %function
.symver pthread_mutexattr_setpshared_2_2_5, pthread_mutexattr_setpshared@@GLIBC_2.2.5, remove
pthread_mutexattr_setpshared_2_2_5: .quad 0
.balign 8
.globl pthread_setschedparam_2_2_5
.type pthread_setschedparam_2_2_5, %function
.symver pthread_setschedparam_2_2_5, pthread_setschedparam@@GLIBC_2.2.5, remove
pthread_setschedparam_2_2_5: .quad 0
.balign 8
.globl pthread_cond_signal_2_2_5
.type pthread_cond_signal_2_2_5, %function
.symver pthread_cond_signal_2_2_5, pthread_cond_signal@GLIBC_2.2.5, remove
pthread_cond_signal_2_2_5: .quad 0
.balign 8
.globl pthread_cond_signal_2_3_2
.type pthread_cond_signal_2_3_2, %function
.symver pthread_cond_signal_2_3_2, pthread_cond_signal@@GLIBC_2.3.2, remove
pthread_cond_signal_2_3_2: .quad 0
.balign 8
.globl sendto_2_2_5
.type sendto_2_2_5, %function
.symver sendto_2_2_5, sendto@@GLIBC_2.2.5, remove
sendto_2_2_5: .quad 0
.balign 8
.globl __open_2_2_5
.type __open_2_2_5, %function
.symver __open_2_2_5, __open@@GLIBC_2.2.5, remove
__open_2_2_5: .quad 0
.balign 8
.globl pthread_exit_2_2_5
.type pthread_exit_2_2_5, %function
.symver pthread_exit_2_2_5, pthread_exit@@GLIBC_2.2.5, remove
pthread_exit_2_2_5: .quad 0
.balign 8
.globl pthread_setcanceltype_2_2_5
.type pthread_setcanceltype_2_2_5, %function
.symver pthread_setcanceltype_2_2_5, pthread_setcanceltype@@GLIBC_2.2.5, remove
pthread_setcanceltype_2_2_5: .quad 0
.balign 8
.globl pthread_kill_other_threads_np_2_2_5
.type pthread_kill_other_threads_np_2_2_5, %function
.symver pthread_kill_other_threads_np_2_2_5, pthread_kill_other_threads_np@@GLIBC_2.2.5, remove
pthread_kill_other_threads_np_2_2_5: .quad 0
.balign 8
.globl pthread_getname_np_2_12
.type pthread_getname_np_2_12, %function
.symver pthread_getname_np_2_12, pthread_getname_np@@GLIBC_2.12, remove
pthread_getname_np_2_12: .quad 0
.balign 8
.globl pthread_getattr_np_2_2_5
.type pthread_getattr_np_2_2_5, %function
.symver pthread_getattr_np_2_2_5, pthread_getattr_np@@GLIBC_2.2.5, remove
pthread_getattr_np_2_2_5: .quad 0
.balign 8
.globl pthread_mutex_timedlock_2_2_5
.type pthread_mutex_timedlock_2_2_5, %function
.symver pthread_mutex_timedlock_2_2_5, pthread_mutex_timedlock@@GLIBC_2.2.5, remove
pthread_mutex_timedlock_2_2_5: .quad 0
.balign 8
.globl raise_2_2_5
.type raise_2_2_5, %function
.symver raise_2_2_5, raise@@GLIBC_2.2.5, remove
raise_2_2_5: .quad 0
.balign 8
.globl __pthread_setspecific_2_2_5
.type __pthread_setspecific_2_2_5, %function
.symver __pthread_setspecific_2_2_5, __pthread_setspecific@@GLIBC_2.2.5, remove
__pthread_setspecific_2_2_5: .quad 0
.balign 8
.globl __pthread_mutexattr_init_2_2_5
.type __pthread_mutexattr_init_2_2_5, %function
.symver __pthread_mutexattr_init_2_2_5, __pthread_mutexattr_init@@GLIBC_2.2.5, remove
__pthread_mutexattr_init_2_2_5: .quad 0
.balign 8
.globl pthread_attr_destroy_2_2_5
.type pthread_attr_destroy_2_2_5, %function
.symver pthread_attr_destroy_2_2_5, pthread_attr_destroy@@GLIBC_2.2.5, remove
pthread_attr_destroy_2_2_5: .quad 0
.balign 8
.globl __fcntl_2_2_5
.type __fcntl_2_2_5, %function
.symver __fcntl_2_2_5, __fcntl@@GLIBC_2.2.5, remove
__fcntl_2_2_5: .quad 0
.balign 8
.globl pread_2_2_5
.type pread_2_2_5, %function
.symver pread_2_2_5, pread@@GLIBC_2.2.5, remove
pread_2_2_5: .quad 0
.balign 8
.globl __pread64_2_2_5
.type __pread64_2_2_5, %function
.symver __pread64_2_2_5, __pread64@@GLIBC_2.2.5, remove
__pread64_2_2_5: .quad 0
.balign 8
.globl sem_timedwait_2_2_5
.type sem_timedwait_2_2_5, %function
.symver sem_timedwait_2_2_5, sem_timedwait@@GLIBC_2.2.5, remove
sem_timedwait_2_2_5: .quad 0
.balign 8
.globl pthread_mutex_unlock_2_2_5
.type pthread_mutex_unlock_2_2_5, %function
.symver pthread_mutex_unlock_2_2_5, pthread_mutex_unlock@@GLIBC_2.2.5, remove
pthread_mutex_unlock_2_2_5: .quad 0
.balign 8
.globl __pthread_mutexattr_settype_2_2_5
.type __pthread_mutexattr_settype_2_2_5, %function
.symver __pthread_mutexattr_settype_2_2_5, __pthread_mutexattr_settype@@GLIBC_2.2.5, remove
__pthread_mutexattr_settype_2_2_5: .quad 0
.balign 8
.globl _pthread_cleanup_pop_2_2_5
.type _pthread_cleanup_pop_2_2_5, %function
.symver _pthread_cleanup_pop_2_2_5, _pthread_cleanup_pop@@GLIBC_2.2.5, remove
_pthread_cleanup_pop_2_2_5: .quad 0
.balign 8
.globl pthread_yield_2_2_5
.type pthread_yield_2_2_5, %function
.symver pthread_yield_2_2_5, pthread_yield@@GLIBC_2.2.5, remove
pthread_yield_2_2_5: .quad 0
.balign 8
.globl pthread_mutex_consistent_2_12
.type pthread_mutex_consistent_2_12, %function
.symver pthread_mutex_consistent_2_12, pthread_mutex_consistent@@GLIBC_2.12, remove
pthread_mutex_consistent_2_12: .quad 0
.balign 8
.globl __pthread_rwlock_wrlock_2_2_5
.type __pthread_rwlock_wrlock_2_2_5, %function
.symver __pthread_rwlock_wrlock_2_2_5, __pthread_rwlock_wrlock@@GLIBC_2.2.5, remove
__pthread_rwlock_wrlock_2_2_5: .quad 0
.balign 8
.globl pthread_join_2_2_5
.type pthread_join_2_2_5, %function
.symver pthread_join_2_2_5, pthread_join@@GLIBC_2.2.5, remove
pthread_join_2_2_5: .quad 0
.balign 8
.globl open_2_2_5
.type open_2_2_5, %function
.symver open_2_2_5, open@@GLIBC_2.2.5, remove
open_2_2_5: .quad 0
.balign 8
.globl pthread_cond_timedwait_2_2_5
.type pthread_cond_timedwait_2_2_5, %function
.symver pthread_cond_timedwait_2_2_5, pthread_cond_timedwait@GLIBC_2.2.5, remove
pthread_cond_timedwait_2_2_5: .quad 0
.balign 8
.globl pthread_cond_timedwait_2_3_2
.type pthread_cond_timedwait_2_3_2, %function
.symver pthread_cond_timedwait_2_3_2, pthread_cond_timedwait@@GLIBC_2.3.2, remove
pthread_cond_timedwait_2_3_2: .quad 0
.balign 8
.globl pthread_mutex_lock_2_2_5
.type pthread_mutex_lock_2_2_5, %function
.symver pthread_mutex_lock_2_2_5, pthread_mutex_lock@@GLIBC_2.2.5, remove
pthread_mutex_lock_2_2_5: .quad 0
.balign 8
.globl pthread_condattr_destroy_2_2_5
.type pthread_condattr_destroy_2_2_5, %function
.symver pthread_condattr_destroy_2_2_5, pthread_condattr_destroy@@GLIBC_2.2.5, remove
pthread_condattr_destroy_2_2_5: .quad 0
.balign 8
.globl pthread_rwlock_rdlock_2_2_5
.type pthread_rwlock_rdlock_2_2_5, %function
.symver pthread_rwlock_rdlock_2_2_5, pthread_rwlock_rdlock@@GLIBC_2.2.5, remove
pthread_rwlock_rdlock_2_2_5: .quad 0
.balign 8
.globl pthread_setspecific_2_2_5
.type pthread_setspecific_2_2_5, %function
.symver pthread_setspecific_2_2_5, pthread_setspecific@@GLIBC_2.2.5, remove
pthread_setspecific_2_2_5: .quad 0
.balign 8
.globl pthread_rwlockattr_getpshared_2_2_5
.type pthread_rwlockattr_getpshared_2_2_5, %function
.symver pthread_rwlockattr_getpshared_2_2_5, pthread_rwlockattr_getpshared@@GLIBC_2.2.5, remove
pthread_rwlockattr_getpshared_2_2_5: .quad 0
.balign 8
.globl lseek64_2_2_5
.type lseek64_2_2_5, %function
.symver lseek64_2_2_5, lseek64@@GLIBC_2.2.5, remove
lseek64_2_2_5: .quad 0
.balign 8
.globl write_2_2_5
.type write_2_2_5, %function
.symver write_2_2_5, write@@GLIBC_2.2.5, remove
write_2_2_5: .quad 0
.balign 8
.globl send_2_2_5
.type send_2_2_5, %function
.symver send_2_2_5, send@@GLIBC_2.2.5, remove
send_2_2_5: .quad 0
.balign 8
.globl pthread_cond_wait_2_2_5
.type pthread_cond_wait_2_2_5, %function
.symver pthread_cond_wait_2_2_5, pthread_cond_wait@GLIBC_2.2.5, remove
pthread_cond_wait_2_2_5: .quad 0
.balign 8
.globl pthread_cond_wait_2_3_2
.type pthread_cond_wait_2_3_2, %function
.symver pthread_cond_wait_2_3_2, pthread_cond_wait@@GLIBC_2.3.2, remove
pthread_cond_wait_2_3_2: .quad 0
.balign 8
.globl pthread_attr_getaffinity_np_2_3_3
.type pthread_attr_getaffinity_np_2_3_3, %function
.symver pthread_attr_getaffinity_np_2_3_3, pthread_attr_getaffinity_np@GLIBC_2.3.3, remove
pthread_attr_getaffinity_np_2_3_3: .quad 0
.balign 8
.globl pthread_attr_getaffinity_np_2_3_4
.type pthread_attr_getaffinity_np_2_3_4, %function
.symver pthread_attr_getaffinity_np_2_3_4, pthread_attr_getaffinity_np@@GLIBC_2.3.4, remove
pthread_attr_getaffinity_np_2_3_4: .quad 0
.balign 8
.globl pthread_key_delete_2_2_5
.type pthread_key_delete_2_2_5, %function
.symver pthread_key_delete_2_2_5, pthread_key_delete@@GLIBC_2.2.5, remove
pthread_key_delete_2_2_5: .quad 0
.balign 8
.globl sem_init_2_2_5
.type sem_init_2_2_5, %function
.symver sem_init_2_2_5, sem_init@@GLIBC_2.2.5, remove
sem_init_2_2_5: .quad 0
.balign 8
.globl pthread_atfork_2_2_5
.type pthread_atfork_2_2_5, %function
.symver pthread_atfork_2_2_5, pthread_atfork@@GLIBC_2.2.5, remove
pthread_atfork_2_2_5: .quad 0
.balign 8
.globl sigwait_2_2_5
.type sigwait_2_2_5, %function
.symver sigwait_2_2_5, sigwait@@GLIBC_2.2.5, remove
sigwait_2_2_5: .quad 0
.balign 8
.globl accept_2_2_5
.type accept_2_2_5, %function
.symver accept_2_2_5, accept@@GLIBC_2.2.5, remove
accept_2_2_5: .quad 0
.balign 8
.globl pthread_rwlockattr_init_2_2_5
.type pthread_rwlockattr_init_2_2_5, %function
.symver pthread_rwlockattr_init_2_2_5, pthread_rwlockattr_init@@GLIBC_2.2.5, remove
pthread_rwlockattr_init_2_2_5: .quad 0
.balign 8
.globl pthread_attr_getschedparam_2_2_5
.type pthread_attr_getschedparam_2_2_5, %function
.symver pthread_attr_getschedparam_2_2_5, pthread_attr_getschedparam@@GLIBC_2.2.5, remove
pthread_attr_getschedparam_2_2_5: .quad 0
.balign 8
.globl pthread_key_create_2_2_5
.type pthread_key_create_2_2_5, %function
.symver pthread_key_create_2_2_5, pthread_key_create@@GLIBC_2.2.5, remove
pthread_key_create_2_2_5: .quad 0
.balign 8
.globl pthread_attr_setscope_2_2_5
.type pthread_attr_setscope_2_2_5, %function
.symver pthread_attr_setscope_2_2_5, pthread_attr_setscope@@GLIBC_2.2.5, remove
pthread_attr_setscope_2_2_5: .quad 0
.balign 8
.globl __pthread_mutex_trylock_2_2_5
.type __pthread_mutex_trylock_2_2_5, %function
.symver __pthread_mutex_trylock_2_2_5, __pthread_mutex_trylock@@GLIBC_2.2.5, remove
__pthread_mutex_trylock_2_2_5: .quad 0
.balign 8
.globl pthread_setconcurrency_2_2_5
.type pthread_setconcurrency_2_2_5, %function
.symver pthread_setconcurrency_2_2_5, pthread_setconcurrency@@GLIBC_2.2.5, remove
pthread_setconcurrency_2_2_5: .quad 0
.balign 8
.globl __libc_allocate_rtsig_2_2_5
.type __libc_allocate_rtsig_2_2_5, %function
.symver __libc_allocate_rtsig_2_2_5, __libc_allocate_rtsig@@GLIBC_2.2.5, remove
__libc_allocate_rtsig_2_2_5: .quad 0
.balign 8
.globl read_2_2_5
.type read_2_2_5, %function
.symver read_2_2_5, read@@GLIBC_2.2.5, remove
read_2_2_5: .quad 0
.balign 8
.globl __pthread_rwlock_init_2_2_5
.type __pthread_rwlock_init_2_2_5, %function
.symver __pthread_rwlock_init_2_2_5, __pthread_rwlock_init@@GLIBC_2.2.5, remove
__pthread_rwlock_init_2_2_5: .quad 0
.balign 8
.globl __pthread_mutex_init_2_2_5
.type __pthread_mutex_init_2_2_5, %function
.symver __pthread_mutex_init_2_2_5, __pthread_mutex_init@@GLIBC_2.2.5, remove
__pthread_mutex_init_2_2_5: .quad 0
.balign 8
.globl pthread_rwlock_tryrdlock_2_2_5
.type pthread_rwlock_tryrdlock_2_2_5, %function
.symver pthread_rwlock_tryrdlock_2_2_5, pthread_rwlock_tryrdlock@@GLIBC_2.2.5, remove
pthread_rwlock_tryrdlock_2_2_5: .quad 0
.balign 8
.globl pthread_attr_getstack_2_2_5
.type pthread_attr_getstack_2_2_5, %function
.symver pthread_attr_getstack_2_2_5, pthread_attr_getstack@@GLIBC_2.2.5, remove
pthread_attr_getstack_2_2_5: .quad 0
.balign 8
.globl pthread_mutexattr_getprotocol_2_4
.type pthread_mutexattr_getprotocol_2_4, %function
.symver pthread_mutexattr_getprotocol_2_4, pthread_mutexattr_getprotocol@@GLIBC_2.4, remove
pthread_mutexattr_getprotocol_2_4: .quad 0
.balign 8
.globl __nanosleep_2_2_6
.type __nanosleep_2_2_6, %function
.symver __nanosleep_2_2_6, __nanosleep@@GLIBC_2.2.6, remove
__nanosleep_2_2_6: .quad 0
.balign 8
.globl pthread_once_2_2_5
.type pthread_once_2_2_5, %function
.symver pthread_once_2_2_5, pthread_once@@GLIBC_2.2.5, remove
pthread_once_2_2_5: .quad 0
.balign 8
.globl pthread_timedjoin_np_2_3_3
.type pthread_timedjoin_np_2_3_3, %function
.symver pthread_timedjoin_np_2_3_3, pthread_timedjoin_np@@GLIBC_2.3.3, remove
pthread_timedjoin_np_2_3_3: .quad 0
.balign 8
.globl pthread_spin_lock_2_2_5
.type pthread_spin_lock_2_2_5, %function
.symver pthread_spin_lock_2_2_5, pthread_spin_lock@@GLIBC_2.2.5, remove
pthread_spin_lock_2_2_5: .quad 0
.balign 8
.globl pthread_barrier_init_2_2_5
.type pthread_barrier_init_2_2_5, %function
.symver pthread_barrier_init_2_2_5, pthread_barrier_init@@GLIBC_2.2.5, remove
pthread_barrier_init_2_2_5: .quad 0
.balign 8
.globl close_2_2_5
.type close_2_2_5, %function
.symver close_2_2_5, close@@GLIBC_2.2.5, remove
close_2_2_5: .quad 0
.balign 8
.globl system_2_2_5
.type system_2_2_5, %function
.symver system_2_2_5, system@@GLIBC_2.2.5, remove
system_2_2_5: .quad 0
.balign 8
.globl __wait_2_2_5
.type __wait_2_2_5, %function
.symver __wait_2_2_5, __wait@@GLIBC_2.2.5, remove
__wait_2_2_5: .quad 0
.balign 8
.globl pthread_barrier_destroy_2_2_5
.type pthread_barrier_destroy_2_2_5, %function
.symver pthread_barrier_destroy_2_2_5, pthread_barrier_destroy@@GLIBC_2.2.5, remove
pthread_barrier_destroy_2_2_5: .quad 0
.balign 8
.globl flockfile_2_2_5
.type flockfile_2_2_5, %function
.symver flockfile_2_2_5, flockfile@@GLIBC_2.2.5, remove
flockfile_2_2_5: .quad 0
.balign 8
.globl pthread_getspecific_2_2_5
.type pthread_getspecific_2_2_5, %function
.symver pthread_getspecific_2_2_5, pthread_getspecific@@GLIBC_2.2.5, remove
pthread_getspecific_2_2_5: .quad 0
.balign 8
.globl __lseek_2_2_5
.type __lseek_2_2_5, %function
.symver __lseek_2_2_5, __lseek@@GLIBC_2.2.5, remove
__lseek_2_2_5: .quad 0
.balign 8
.globl pthread_barrierattr_getpshared_2_3_3
.type pthread_barrierattr_getpshared_2_3_3, %function
.symver pthread_barrierattr_getpshared_2_3_3, pthread_barrierattr_getpshared@@GLIBC_2.3.3, remove
pthread_barrierattr_getpshared_2_3_3: .quad 0
.balign 8
.globl pthread_rwlockattr_setpshared_2_2_5
.type pthread_rwlockattr_setpshared_2_2_5, %function
.symver pthread_rwlockattr_setpshared_2_2_5, pthread_rwlockattr_setpshared@@GLIBC_2.2.5, remove
pthread_rwlockattr_setpshared_2_2_5: .quad 0
.balign 8
.globl waitpid_2_2_5
.type waitpid_2_2_5, %function
.symver waitpid_2_2_5, waitpid@@GLIBC_2.2.5, remove
waitpid_2_2_5: .quad 0
.balign 8
.globl pthread_tryjoin_np_2_3_3
.type pthread_tryjoin_np_2_3_3, %function
.symver pthread_tryjoin_np_2_3_3, pthread_tryjoin_np@@GLIBC_2.3.3, remove
pthread_tryjoin_np_2_3_3: .quad 0
.balign 8
.globl pthread_sigmask_2_2_5
.type pthread_sigmask_2_2_5, %function
.symver pthread_sigmask_2_2_5, pthread_sigmask@@GLIBC_2.2.5, remove
pthread_sigmask_2_2_5: .quad 0
.balign 8
.globl __libc_current_sigrtmin_2_2_5
.type __libc_current_sigrtmin_2_2_5, %function
.symver __libc_current_sigrtmin_2_2_5, __libc_current_sigrtmin@@GLIBC_2.2.5, remove
__libc_current_sigrtmin_2_2_5: .quad 0
.balign 8
.globl __vfork_2_2_5
.type __vfork_2_2_5, %function
.symver __vfork_2_2_5, __vfork@@GLIBC_2.2.5, remove
__vfork_2_2_5: .quad 0
.balign 8
.globl pthread_attr_setstackaddr_2_2_5
.type pthread_attr_setstackaddr_2_2_5, %function
.symver pthread_attr_setstackaddr_2_2_5, pthread_attr_setstackaddr@@GLIBC_2.2.5, remove
pthread_attr_setstackaddr_2_2_5: .quad 0
.balign 8
.globl __pthread_key_create_2_2_5
.type __pthread_key_create_2_2_5, %function
.symver __pthread_key_create_2_2_5, __pthread_key_create@@GLIBC_2.2.5, remove
__pthread_key_create_2_2_5: .quad 0
.balign 8
.globl tcdrain_2_2_5
.type tcdrain_2_2_5, %function
.symver tcdrain_2_2_5, tcdrain@@GLIBC_2.2.5, remove
tcdrain_2_2_5: .quad 0
.balign 8
.globl ftrylockfile_2_2_5
.type ftrylockfile_2_2_5, %function
.symver ftrylockfile_2_2_5, ftrylockfile@@GLIBC_2.2.5, remove
ftrylockfile_2_2_5: .quad 0
.balign 8
.globl pthread_kill_2_2_5
.type pthread_kill_2_2_5, %function
.symver pthread_kill_2_2_5, pthread_kill@@GLIBC_2.2.5, remove
pthread_kill_2_2_5: .quad 0
.balign 8
.globl pthread_barrierattr_init_2_2_5
.type pthread_barrierattr_init_2_2_5, %function
.symver pthread_barrierattr_init_2_2_5, pthread_barrierattr_init@@GLIBC_2.2.5, remove
pthread_barrierattr_init_2_2_5: .quad 0
.balign 8
.globl lseek_2_2_5
.type lseek_2_2_5, %function
.symver lseek_2_2_5, lseek@@GLIBC_2.2.5, remove
lseek_2_2_5: .quad 0
.balign 8
.globl pthread_rwlock_trywrlock_2_2_5
.type pthread_rwlock_trywrlock_2_2_5, %function
.symver pthread_rwlock_trywrlock_2_2_5, pthread_rwlock_trywrlock@@GLIBC_2.2.5, remove
pthread_rwlock_trywrlock_2_2_5: .quad 0
.balign 8
.globl __pthread_rwlock_destroy_2_2_5
.type __pthread_rwlock_destroy_2_2_5, %function
.symver __pthread_rwlock_destroy_2_2_5, __pthread_rwlock_destroy@@GLIBC_2.2.5, remove
__pthread_rwlock_destroy_2_2_5: .quad 0
.balign 8
.globl recv_2_2_5
.type recv_2_2_5, %function
.symver recv_2_2_5, recv@@GLIBC_2.2.5, remove
recv_2_2_5: .quad 0
.balign 8
.globl pthread_testcancel_2_2_5
.type pthread_testcancel_2_2_5, %function
.symver pthread_testcancel_2_2_5, pthread_testcancel@@GLIBC_2.2.5, remove
pthread_testcancel_2_2_5: .quad 0
.balign 8
.globl pthread_rwlock_destroy_2_2_5
.type pthread_rwlock_destroy_2_2_5, %function
.symver pthread_rwlock_destroy_2_2_5, pthread_rwlock_destroy@@GLIBC_2.2.5, remove
pthread_rwlock_destroy_2_2_5: .quad 0
.balign 8
.globl pthread_attr_getinheritsched_2_2_5
.type pthread_attr_getinheritsched_2_2_5, %function
.symver pthread_attr_getinheritsched_2_2_5, pthread_attr_getinheritsched@@GLIBC_2.2.5, remove
pthread_attr_getinheritsched_2_2_5: .quad 0
.balign 8
.globl __close_2_2_5
.type __close_2_2_5, %function
.symver __close_2_2_5, __close@@GLIBC_2.2.5, remove
__close_2_2_5: .quad 0
.balign 8
.globl pthread_rwlockattr_destroy_2_2_5
.type pthread_rwlockattr_destroy_2_2_5, %function
.symver pthread_rwlockattr_destroy_2_2_5, pthread_rwlockattr_destroy@@GLIBC_2.2.5, remove
pthread_rwlockattr_destroy_2_2_5: .quad 0
.balign 8
.globl __pthread_mutexattr_destroy_2_2_5
.type __pthread_mutexattr_destroy_2_2_5, %function
.symver __pthread_mutexattr_destroy_2_2_5, __pthread_mutexattr_destroy@@GLIBC_2.2.5, remove
__pthread_mutexattr_destroy_2_2_5: .quad 0
.balign 8
.globl sem_unlink_2_2_5
.type sem_unlink_2_2_5, %function
.symver sem_unlink_2_2_5, sem_unlink@@GLIBC_2.2.5, remove
sem_unlink_2_2_5: .quad 0
.balign 8
.globl sem_close_2_2_5
.type sem_close_2_2_5, %function
.symver sem_close_2_2_5, sem_close@@GLIBC_2.2.5, remove
sem_close_2_2_5: .quad 0
.balign 8
.globl pthread_condattr_init_2_2_5
.type pthread_condattr_init_2_2_5, %function
.symver pthread_condattr_init_2_2_5, pthread_condattr_init@@GLIBC_2.2.5, remove
pthread_condattr_init_2_2_5: .quad 0
.balign 8
.globl pthread_attr_getschedpolicy_2_2_5
.type pthread_attr_getschedpolicy_2_2_5, %function
.symver pthread_attr_getschedpolicy_2_2_5, pthread_attr_getschedpolicy@@GLIBC_2.2.5, remove
pthread_attr_getschedpolicy_2_2_5: .quad 0
.balign 8
.globl __errno_location_2_2_5
.type __errno_location_2_2_5, %function
.symver __errno_location_2_2_5, __errno_location@@GLIBC_2.2.5, remove
__errno_location_2_2_5: .quad 0
.balign 8
.globl pthread_cancel_2_2_5
.type pthread_cancel_2_2_5, %function
.symver pthread_cancel_2_2_5, pthread_cancel@@GLIBC_2.2.5, remove
pthread_cancel_2_2_5: .quad 0
.balign 8
.globl pthread_barrierattr_setpshared_2_2_5
.type pthread_barrierattr_setpshared_2_2_5, %function
.symver pthread_barrierattr_setpshared_2_2_5, pthread_barrierattr_setpshared@@GLIBC_2.2.5, remove
pthread_barrierattr_setpshared_2_2_5: .quad 0
.balign 8
.globl pthread_spin_unlock_2_2_5
.type pthread_spin_unlock_2_2_5, %function
.symver pthread_spin_unlock_2_2_5, pthread_spin_unlock@@GLIBC_2.2.5, remove
pthread_spin_unlock_2_2_5: .quad 0
.balign 8
.globl __pthread_mutex_destroy_2_2_5
.type __pthread_mutex_destroy_2_2_5, %function
.symver __pthread_mutex_destroy_2_2_5, __pthread_mutex_destroy@@GLIBC_2.2.5, remove
__pthread_mutex_destroy_2_2_5: .quad 0
.balign 8
.globl pthread_attr_getdetachstate_2_2_5
.type pthread_attr_getdetachstate_2_2_5, %function
.symver pthread_attr_getdetachstate_2_2_5, pthread_attr_getdetachstate@@GLIBC_2.2.5, remove
pthread_attr_getdetachstate_2_2_5: .quad 0
.balign 8
.globl pthread_setaffinity_np_2_3_3
.type pthread_setaffinity_np_2_3_3, %function
.symver pthread_setaffinity_np_2_3_3, pthread_setaffinity_np@GLIBC_2.3.3, remove
pthread_setaffinity_np_2_3_3: .quad 0
.balign 8
.globl pthread_setaffinity_np_2_3_4
.type pthread_setaffinity_np_2_3_4, %function
.symver pthread_setaffinity_np_2_3_4, pthread_setaffinity_np@@GLIBC_2.3.4, remove
pthread_setaffinity_np_2_3_4: .quad 0
.balign 8
.globl pthread_rwlock_timedrdlock_2_2_5
.type pthread_rwlock_timedrdlock_2_2_5, %function
.symver pthread_rwlock_timedrdlock_2_2_5, pthread_rwlock_timedrdlock@@GLIBC_2.2.5, remove
pthread_rwlock_timedrdlock_2_2_5: .quad 0
.balign 8
.globl pthread_attr_getguardsize_2_2_5
.type pthread_attr_getguardsize_2_2_5, %function
.symver pthread_attr_getguardsize_2_2_5, pthread_attr_getguardsize@@GLIBC_2.2.5, remove
pthread_attr_getguardsize_2_2_5: .quad 0
.balign 8
.globl _pthread_cleanup_push_2_2_5
.type _pthread_cleanup_push_2_2_5, %function
.symver _pthread_cleanup_push_2_2_5, _pthread_cleanup_push@@GLIBC_2.2.5, remove
_pthread_cleanup_push_2_2_5: .quad 0
.balign 8
.globl pthread_mutex_setprioceiling_2_4
.type pthread_mutex_setprioceiling_2_4, %function
.symver pthread_mutex_setprioceiling_2_4, pthread_mutex_setprioceiling@@GLIBC_2.4, remove
pthread_mutex_setprioceiling_2_4: .quad 0
.balign 8
.globl siglongjmp_2_2_5
.type siglongjmp_2_2_5, %function
.symver siglongjmp_2_2_5, siglongjmp@@GLIBC_2.2.5, remove
siglongjmp_2_2_5: .quad 0
.rodata
.data
