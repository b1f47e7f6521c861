.text
.balign 8
.globl endprotoent_2_2_5
.type endprotoent_2_2_5, %function
.symver endprotoent_2_2_5, endprotoent@@GLIBC_2.2.5, remove
endprotoent_2_2_5: .quad 0
.balign 8
.globl sscanf_2_2_5
.type sscanf_2_2_5, %function
.symver sscanf_2_2_5, sscanf@@GLIBC_2.2.5, remove
sscanf_2_2_5: .quad 0
.balign 8
.globl timelocal_2_2_5
.type timelocal_2_2_5, %function
.symver timelocal_2_2_5, timelocal@@GLIBC_2.2.5, remove
timelocal_2_2_5: .quad 0
.balign 8
.globl _IO_fread_2_2_5
.type _IO_fread_2_2_5, %function
.symver _IO_fread_2_2_5, _IO_fread@@GLIBC_2.2.5, remove
_IO_fread_2_2_5: .quad 0
.balign 8
.globl wcsdup_2_2_5
.type wcsdup_2_2_5, %function
.symver wcsdup_2_2_5, wcsdup@@GLIBC_2.2.5, remove
wcsdup_2_2_5: .quad 0
.balign 8
.globl xdr_cryptkeyarg_2_2_5
.type xdr_cryptkeyarg_2_2_5, %function
.symver xdr_cryptkeyarg_2_2_5, xdr_cryptkeyarg@@GLIBC_2.2.5, remove
xdr_cryptkeyarg_2_2_5: .quad 0
.balign 8
.globl __isprint_l_2_2_5
.type __isprint_l_2_2_5, %function
.symver __isprint_l_2_2_5, __isprint_l@@GLIBC_2.2.5, remove
__isprint_l_2_2_5: .quad 0
.balign 8
.globl wcsncasecmp_2_2_5
.type wcsncasecmp_2_2_5, %function
.symver wcsncasecmp_2_2_5, wcsncasecmp@@GLIBC_2.2.5, remove
wcsncasecmp_2_2_5: .quad 0
.balign 8
.globl __getdelim_2_2_5
.type __getdelim_2_2_5, %function
.symver __getdelim_2_2_5, __getdelim@@GLIBC_2.2.5, remove
__getdelim_2_2_5: .quad 0
.balign 8
.globl __wcstoll_l_2_2_5
.type __wcstoll_l_2_2_5, %function
.symver __wcstoll_l_2_2_5, __wcstoll_l@@GLIBC_2.2.5, remove
__wcstoll_l_2_2_5: .quad 0
.balign 8
.globl __iscntrl_l_2_2_5
.type __iscntrl_l_2_2_5, %function
.symver __iscntrl_l_2_2_5, __iscntrl_l@@GLIBC_2.2.5, remove
__iscntrl_l_2_2_5: .quad 0
.balign 8
.globl advance_2_2_5
.type advance_2_2_5, %function
.symver advance_2_2_5, advance@@GLIBC_2.2.5, remove
advance_2_2_5: .quad 0
.balign 8
.globl __pipe_2_2_5
.type __pipe_2_2_5, %function
.symver __pipe_2_2_5, __pipe@@GLIBC_2.2.5, remove
__pipe_2_2_5: .quad 0
.balign 8
.globl fcntl_2_2_5
.type fcntl_2_2_5, %function
.symver fcntl_2_2_5, fcntl@@GLIBC_2.2.5, remove
fcntl_2_2_5: .quad 0
.balign 8
.globl vfwscanf_2_2_5
.type vfwscanf_2_2_5, %function
.symver vfwscanf_2_2_5, vfwscanf@@GLIBC_2.2.5, remove
vfwscanf_2_2_5: .quad 0
.balign 8
.globl fopen_2_2_5
.type fopen_2_2_5, %function
.symver fopen_2_2_5, fopen@@GLIBC_2.2.5, remove
fopen_2_2_5: .quad 0
.balign 8
.globl _IO_ferror_2_2_5
.type _IO_ferror_2_2_5, %function
.symver _IO_ferror_2_2_5, _IO_ferror@@GLIBC_2.2.5, remove
_IO_ferror_2_2_5: .quad 0
.balign 8
.globl __obstack_vprintf_chk_2_8
.type __obstack_vprintf_chk_2_8, %function
.symver __obstack_vprintf_chk_2_8, __obstack_vprintf_chk@@GLIBC_2.8, remove
__obstack_vprintf_chk_2_8: .quad 0
.balign 8
.globl creat64_2_2_5
.type creat64_2_2_5, %function
.symver creat64_2_2_5, creat64@@GLIBC_2.2.5, remove
creat64_2_2_5: .quad 0
.balign 8
.globl posix_spawnattr_setschedparam_2_2_5
.type posix_spawnattr_setschedparam_2_2_5, %function
.symver posix_spawnattr_setschedparam_2_2_5, posix_spawnattr_setschedparam@@GLIBC_2.2.5, remove
posix_spawnattr_setschedparam_2_2_5: .quad 0
.balign 8
.globl recvmsg_2_2_5
.type recvmsg_2_2_5, %function
.symver recvmsg_2_2_5, recvmsg@@GLIBC_2.2.5, remove
recvmsg_2_2_5: .quad 0
.balign 8
.globl lfind_2_2_5
.type lfind_2_2_5, %function
.symver lfind_2_2_5, lfind@@GLIBC_2.2.5, remove
lfind_2_2_5: .quad 0
.balign 8
.globl _IO_iter_begin_2_2_5
.type _IO_iter_begin_2_2_5, %function
.symver _IO_iter_begin_2_2_5, _IO_iter_begin@@GLIBC_2.2.5, remove
_IO_iter_begin_2_2_5: .quad 0
.balign 8
.globl inet6_option_find_2_3_3
.type inet6_option_find_2_3_3, %function
.symver inet6_option_find_2_3_3, inet6_option_find@@GLIBC_2.3.3, remove
inet6_option_find_2_3_3: .quad 0
.balign 8
.globl __readlinkat_chk_2_5
.type __readlinkat_chk_2_5, %function
.symver __readlinkat_chk_2_5, __readlinkat_chk@@GLIBC_2.5, remove
__readlinkat_chk_2_5: .quad 0
.balign 8
.globl endusershell_2_2_5
.type endusershell_2_2_5, %function
.symver endusershell_2_2_5, endusershell@@GLIBC_2.2.5, remove
endusershell_2_2_5: .quad 0
.balign 8
.globl mbrlen_2_2_5
.type mbrlen_2_2_5, %function
.symver mbrlen_2_2_5, mbrlen@@GLIBC_2.2.5, remove
mbrlen_2_2_5: .quad 0
.balign 8
.globl updwtmpx_2_2_5
.type updwtmpx_2_2_5, %function
.symver updwtmpx_2_2_5, updwtmpx@@GLIBC_2.2.5, remove
updwtmpx_2_2_5: .quad 0
.balign 8
.globl __isoc99_vscanf_2_7
.type __isoc99_vscanf_2_7, %function
.symver __isoc99_vscanf_2_7, __isoc99_vscanf@@GLIBC_2.7, remove
__isoc99_vscanf_2_7: .quad 0
.balign 8
.globl fsync_2_2_5
.type fsync_2_2_5, %function
.symver fsync_2_2_5, fsync@@GLIBC_2.2.5, remove
fsync_2_2_5: .quad 0
.balign 8
.globl tr_break_2_2_5
.type tr_break_2_2_5, %function
.symver tr_break_2_2_5, tr_break@@GLIBC_2.2.5, remove
tr_break_2_2_5: .quad 0
.balign 8
.globl __strtold_internal_2_2_5
.type __strtold_internal_2_2_5, %function
.symver __strtold_internal_2_2_5, __strtold_internal@@GLIBC_2.2.5, remove
__strtold_internal_2_2_5: .quad 0
.balign 8
.globl __mbsnrtowcs_chk_2_4
.type __mbsnrtowcs_chk_2_4, %function
.symver __mbsnrtowcs_chk_2_4, __mbsnrtowcs_chk@@GLIBC_2.4, remove
__mbsnrtowcs_chk_2_4: .quad 0
.balign 8
.globl fallocate_2_10
.type fallocate_2_10, %function
.symver fallocate_2_10, fallocate@@GLIBC_2.10, remove
fallocate_2_10: .quad 0
.balign 8
.globl __wcscasecmp_l_2_2_5
.type __wcscasecmp_l_2_2_5, %function
.symver __wcscasecmp_l_2_2_5, __wcscasecmp_l@@GLIBC_2.2.5, remove
__wcscasecmp_l_2_2_5: .quad 0
.balign 8
.globl towlower_2_2_5
.type towlower_2_2_5, %function
.symver towlower_2_2_5, towlower@@GLIBC_2.2.5, remove
towlower_2_2_5: .quad 0
.balign 8
.globl memchr_2_2_5
.type memchr_2_2_5, %function
.symver memchr_2_2_5, memchr@@GLIBC_2.2.5, remove
memchr_2_2_5: .quad 0
.balign 8
.globl strerror_r_2_2_5
.type strerror_r_2_2_5, %function
.symver strerror_r_2_2_5, strerror_r@@GLIBC_2.2.5, remove
strerror_r_2_2_5: .quad 0
.balign 8
.globl __isinf_2_2_5
.type __isinf_2_2_5, %function
.symver __isinf_2_2_5, __isinf@@GLIBC_2.2.5, remove
__isinf_2_2_5: .quad 0
.balign 8
.globl strtok_r_2_2_5
.type strtok_r_2_2_5, %function
.symver strtok_r_2_2_5, strtok_r@@GLIBC_2.2.5, remove
strtok_r_2_2_5: .quad 0
.balign 8
.globl umount_2_2_5
.type umount_2_2_5, %function
.symver umount_2_2_5, umount@@GLIBC_2.2.5, remove
umount_2_2_5: .quad 0
.balign 8
.globl xdr_u_short_2_2_5
.type xdr_u_short_2_2_5, %function
.symver xdr_u_short_2_2_5, xdr_u_short@@GLIBC_2.2.5, remove
xdr_u_short_2_2_5: .quad 0
.balign 8
.globl getgrnam_r_2_2_5
.type getgrnam_r_2_2_5, %function
.symver getgrnam_r_2_2_5, getgrnam_r@@GLIBC_2.2.5, remove
getgrnam_r_2_2_5: .quad 0
.balign 8
.globl __gets_chk_2_3_4
.type __gets_chk_2_3_4, %function
.symver __gets_chk_2_3_4, __gets_chk@@GLIBC_2.3.4, remove
__gets_chk_2_3_4: .quad 0
.balign 8
.globl __isnanl_2_2_5
.type __isnanl_2_2_5, %function
.symver __isnanl_2_2_5, __isnanl@@GLIBC_2.2.5, remove
__isnanl_2_2_5: .quad 0
.balign 8
.globl endsgent_2_10
.type endsgent_2_10, %function
.symver endsgent_2_10, endsgent@@GLIBC_2.10, remove
endsgent_2_10: .quad 0
.balign 8
.globl svcraw_create_2_2_5
.type svcraw_create_2_2_5, %function
.symver svcraw_create_2_2_5, svcraw_create@@GLIBC_2.2.5, remove
svcraw_create_2_2_5: .quad 0
.balign 8
.globl vsscanf_2_2_5
.type vsscanf_2_2_5, %function
.symver vsscanf_2_2_5, vsscanf@@GLIBC_2.2.5, remove
vsscanf_2_2_5: .quad 0
.balign 8
.globl argz_extract_2_2_5
.type argz_extract_2_2_5, %function
.symver argz_extract_2_2_5, argz_extract@@GLIBC_2.2.5, remove
argz_extract_2_2_5: .quad 0
.balign 8
.globl confstr_2_2_5
.type confstr_2_2_5, %function
.symver confstr_2_2_5, confstr@@GLIBC_2.2.5, remove
confstr_2_2_5: .quad 0
.balign 8
.globl xdr_u_hyper_2_2_5
.type xdr_u_hyper_2_2_5, %function
.symver xdr_u_hyper_2_2_5, xdr_u_hyper@@GLIBC_2.2.5, remove
xdr_u_hyper_2_2_5: .quad 0
.balign 8
.globl __res_state_2_2_5
.type __res_state_2_2_5, %function
.symver __res_state_2_2_5, __res_state@@GLIBC_2.2.5, remove
__res_state_2_2_5: .quad 0
.balign 8
.globl bsd_signal_2_2_5
.type bsd_signal_2_2_5, %function
.symver bsd_signal_2_2_5, bsd_signal@@GLIBC_2.2.5, remove
bsd_signal_2_2_5: .quad 0
.balign 8
.globl fgetc_2_2_5
.type fgetc_2_2_5, %function
.symver fgetc_2_2_5, fgetc@@GLIBC_2.2.5, remove
fgetc_2_2_5: .quad 0
.balign 8
.globl inet6_option_append_2_3_3
.type inet6_option_append_2_3_3, %function
.symver inet6_option_append_2_3_3, inet6_option_append@@GLIBC_2.3.3, remove
inet6_option_append_2_3_3: .quad 0
.balign 8
.globl calloc_2_2_5
.type calloc_2_2_5, %function
.symver calloc_2_2_5, calloc@@GLIBC_2.2.5, remove
calloc_2_2_5: .quad 0
.balign 8
.globl iswctype_2_2_5
.type iswctype_2_2_5, %function
.symver iswctype_2_2_5, iswctype@@GLIBC_2.2.5, remove
iswctype_2_2_5: .quad 0
.balign 8
.globl wcslen_2_2_5
.type wcslen_2_2_5, %function
.symver wcslen_2_2_5, wcslen@@GLIBC_2.2.5, remove
wcslen_2_2_5: .quad 0
.balign 8
.globl getutline_r_2_2_5
.type getutline_r_2_2_5, %function
.symver getutline_r_2_2_5, getutline_r@@GLIBC_2.2.5, remove
getutline_r_2_2_5: .quad 0
.balign 8
.globl sigstack_2_2_5
.type sigstack_2_2_5, %function
.symver sigstack_2_2_5, sigstack@@GLIBC_2.2.5, remove
sigstack_2_2_5: .quad 0
.balign 8
.globl getifaddrs_2_3
.type getifaddrs_2_3, %function
.symver getifaddrs_2_3, getifaddrs@@GLIBC_2.3, remove
getifaddrs_2_3: .quad 0
.balign 8
.globl strncpy_2_2_5
.type strncpy_2_2_5, %function
.symver strncpy_2_2_5, strncpy@@GLIBC_2.2.5, remove
strncpy_2_2_5: .quad 0
.balign 8
.globl strtold_2_2_5
.type strtold_2_2_5, %function
.symver strtold_2_2_5, strtold@@GLIBC_2.2.5, remove
strtold_2_2_5: .quad 0
.balign 8
.globl sethostname_2_2_5
.type sethostname_2_2_5, %function
.symver sethostname_2_2_5, sethostname@@GLIBC_2.2.5, remove
sethostname_2_2_5: .quad 0
.balign 8
.globl timespec_get_2_16
.type timespec_get_2_16, %function
.symver timespec_get_2_16, timespec_get@@GLIBC_2.16, remove
timespec_get_2_16: .quad 0
.balign 8
.globl verrx_2_2_5
.type verrx_2_2_5, %function
.symver verrx_2_2_5, verrx@@GLIBC_2.2.5, remove
verrx_2_2_5: .quad 0
.balign 8
.globl _IO_sprintf_2_2_5
.type _IO_sprintf_2_2_5, %function
.symver _IO_sprintf_2_2_5, _IO_sprintf@@GLIBC_2.2.5, remove
_IO_sprintf_2_2_5: .quad 0
.balign 8
.globl fread_2_2_5
.type fread_2_2_5, %function
.symver fread_2_2_5, fread@@GLIBC_2.2.5, remove
fread_2_2_5: .quad 0
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
.globl __wcstoll_internal_2_2_5
.type __wcstoll_internal_2_2_5, %function
.symver __wcstoll_internal_2_2_5, __wcstoll_internal@@GLIBC_2.2.5, remove
__wcstoll_internal_2_2_5: .quad 0
.balign 8
.globl __strcat_chk_2_3_4
.type __strcat_chk_2_3_4, %function
.symver __strcat_chk_2_3_4, __strcat_chk@@GLIBC_2.3.4, remove
__strcat_chk_2_3_4: .quad 0
.balign 8
.globl vwprintf_2_2_5
.type vwprintf_2_2_5, %function
.symver vwprintf_2_2_5, vwprintf@@GLIBC_2.2.5, remove
vwprintf_2_2_5: .quad 0
.balign 8
.globl sprintf_2_2_5
.type sprintf_2_2_5, %function
.symver sprintf_2_2_5, sprintf@@GLIBC_2.2.5, remove
sprintf_2_2_5: .quad 0
.balign 8
.globl getservbyname_2_2_5
.type getservbyname_2_2_5, %function
.symver getservbyname_2_2_5, getservbyname@@GLIBC_2.2.5, remove
getservbyname_2_2_5: .quad 0
.balign 8
.globl l64a_2_2_5
.type l64a_2_2_5, %function
.symver l64a_2_2_5, l64a@@GLIBC_2.2.5, remove
l64a_2_2_5: .quad 0
.balign 8
.globl getpwnam_r_2_2_5
.type getpwnam_r_2_2_5, %function
.symver getpwnam_r_2_2_5, getpwnam_r@@GLIBC_2.2.5, remove
getpwnam_r_2_2_5: .quad 0
.balign 8
.globl _IO_sscanf_2_2_5
.type _IO_sscanf_2_2_5, %function
.symver _IO_sscanf_2_2_5, _IO_sscanf@@GLIBC_2.2.5, remove
_IO_sscanf_2_2_5: .quad 0
.balign 8
.globl mbtowc_2_2_5
.type mbtowc_2_2_5, %function
.symver mbtowc_2_2_5, mbtowc@@GLIBC_2.2.5, remove
mbtowc_2_2_5: .quad 0
.balign 8
.globl endservent_2_2_5
.type endservent_2_2_5, %function
.symver endservent_2_2_5, endservent@@GLIBC_2.2.5, remove
endservent_2_2_5: .quad 0
.balign 8
.globl isgraph_2_2_5
.type isgraph_2_2_5, %function
.symver isgraph_2_2_5, isgraph@@GLIBC_2.2.5, remove
isgraph_2_2_5: .quad 0
.balign 8
.globl __strtol_l_2_2_5
.type __strtol_l_2_2_5, %function
.symver __strtol_l_2_2_5, __strtol_l@@GLIBC_2.2.5, remove
__strtol_l_2_2_5: .quad 0
.balign 8
.globl __read_2_2_5
.type __read_2_2_5, %function
.symver __read_2_2_5, __read@@GLIBC_2.2.5, remove
__read_2_2_5: .quad 0
.balign 8
.globl __strftime_l_2_3
.type __strftime_l_2_3, %function
.symver __strftime_l_2_3, __strftime_l@@GLIBC_2.3, remove
__strftime_l_2_3: .quad 0
.balign 8
.globl sigaction_2_2_5
.type sigaction_2_2_5, %function
.symver sigaction_2_2_5, sigaction@@GLIBC_2.2.5, remove
sigaction_2_2_5: .quad 0
.balign 8
.globl strtol_2_2_5
.type strtol_2_2_5, %function
.symver strtol_2_2_5, strtol@@GLIBC_2.2.5, remove
strtol_2_2_5: .quad 0
.balign 8
.globl __strerror_r_2_2_5
.type __strerror_r_2_2_5, %function
.symver __strerror_r_2_2_5, __strerror_r@@GLIBC_2.2.5, remove
__strerror_r_2_2_5: .quad 0
.balign 8
.globl isinff_2_2_5
.type isinff_2_2_5, %function
.symver isinff_2_2_5, isinff@@GLIBC_2.2.5, remove
isinff_2_2_5: .quad 0
.balign 8
.globl drand48_r_2_2_5
.type drand48_r_2_2_5, %function
.symver drand48_r_2_2_5, drand48_r@@GLIBC_2.2.5, remove
drand48_r_2_2_5: .quad 0
.balign 8
.globl tmpnam_2_2_5
.type tmpnam_2_2_5, %function
.symver tmpnam_2_2_5, tmpnam@@GLIBC_2.2.5, remove
tmpnam_2_2_5: .quad 0
.balign 8
.globl setgrent_2_2_5
.type setgrent_2_2_5, %function
.symver setgrent_2_2_5, setgrent@@GLIBC_2.2.5, remove
setgrent_2_2_5: .quad 0
.balign 8
.globl getpagesize_2_2_5
.type getpagesize_2_2_5, %function
.symver getpagesize_2_2_5, getpagesize@@GLIBC_2.2.5, remove
getpagesize_2_2_5: .quad 0
.balign 8
.globl tfind_2_2_5
.type tfind_2_2_5, %function
.symver tfind_2_2_5, tfind@@GLIBC_2.2.5, remove
tfind_2_2_5: .quad 0
.balign 8
.globl sched_getscheduler_2_2_5
.type sched_getscheduler_2_2_5, %function
.symver sched_getscheduler_2_2_5, sched_getscheduler@@GLIBC_2.2.5, remove
sched_getscheduler_2_2_5: .quad 0
.balign 8
.globl strcpy_2_2_5
.type strcpy_2_2_5, %function
.symver strcpy_2_2_5, strcpy@@GLIBC_2.2.5, remove
strcpy_2_2_5: .quad 0
.balign 8
.globl posix_spawnattr_getpgroup_2_2_5
.type posix_spawnattr_getpgroup_2_2_5, %function
.symver posix_spawnattr_getpgroup_2_2_5, posix_spawnattr_getpgroup@@GLIBC_2.2.5, remove
posix_spawnattr_getpgroup_2_2_5: .quad 0
.balign 8
.globl srand_2_2_5
.type srand_2_2_5, %function
.symver srand_2_2_5, srand@@GLIBC_2.2.5, remove
srand_2_2_5: .quad 0
.balign 8
.globl htons_2_2_5
.type htons_2_2_5, %function
.symver htons_2_2_5, htons@@GLIBC_2.2.5, remove
htons_2_2_5: .quad 0
.balign 8
.globl setnetgrent_2_2_5
.type setnetgrent_2_2_5, %function
.symver setnetgrent_2_2_5, setnetgrent@@GLIBC_2.2.5, remove
setnetgrent_2_2_5: .quad 0
.balign 8
.globl argz_count_2_2_5
.type argz_count_2_2_5, %function
.symver argz_count_2_2_5, argz_count@@GLIBC_2.2.5, remove
argz_count_2_2_5: .quad 0
.balign 8
.globl strftime_l_2_3
.type strftime_l_2_3, %function
.symver strftime_l_2_3, strftime_l@@GLIBC_2.3, remove
strftime_l_2_3: .quad 0
.balign 8
.globl __stpncpy_2_2_5
.type __stpncpy_2_2_5, %function
.symver __stpncpy_2_2_5, __stpncpy@@GLIBC_2.2.5, remove
__stpncpy_2_2_5: .quad 0
.balign 8
.globl setsid_2_2_5
.type setsid_2_2_5, %function
.symver setsid_2_2_5, setsid@@GLIBC_2.2.5, remove
setsid_2_2_5: .quad 0
.balign 8
.globl rand_2_2_5
.type rand_2_2_5, %function
.symver rand_2_2_5, rand@@GLIBC_2.2.5, remove
rand_2_2_5: .quad 0
.balign 8
.globl inet6_rth_space_2_5
.type inet6_rth_space_2_5, %function
.symver inet6_rth_space_2_5, inet6_rth_space@@GLIBC_2.5, remove
inet6_rth_space_2_5: .quad 0
.balign 8
.globl strtoull_2_2_5
.type strtoull_2_2_5, %function
.symver strtoull_2_2_5, strtoull@@GLIBC_2.2.5, remove
strtoull_2_2_5: .quad 0
.balign 8
.globl poll_2_2_5
.type poll_2_2_5, %function
.symver poll_2_2_5, poll@@GLIBC_2.2.5, remove
poll_2_2_5: .quad 0
.balign 8
.globl _IO_wdefault_xsputn_2_2_5
.type _IO_wdefault_xsputn_2_2_5, %function
.symver _IO_wdefault_xsputn_2_2_5, _IO_wdefault_xsputn@@GLIBC_2.2.5, remove
_IO_wdefault_xsputn_2_2_5: .quad 0
.balign 8
.globl mkstemp_2_2_5
.type mkstemp_2_2_5, %function
.symver mkstemp_2_2_5, mkstemp@@GLIBC_2.2.5, remove
mkstemp_2_2_5: .quad 0
.balign 8
.globl _IO_wmarker_delta_2_2_5
.type _IO_wmarker_delta_2_2_5, %function
.symver _IO_wmarker_delta_2_2_5, _IO_wmarker_delta@@GLIBC_2.2.5, remove
_IO_wmarker_delta_2_2_5: .quad 0
.balign 8
.globl sysv_signal_2_2_5
.type sysv_signal_2_2_5, %function
.symver sysv_signal_2_2_5, sysv_signal@@GLIBC_2.2.5, remove
sysv_signal_2_2_5: .quad 0
.balign 8
.globl sigblock_2_2_5
.type sigblock_2_2_5, %function
.symver sigblock_2_2_5, sigblock@@GLIBC_2.2.5, remove
sigblock_2_2_5: .quad 0
.balign 8
.globl sched_setaffinity_2_3_3
.type sched_setaffinity_2_3_3, %function
.symver sched_setaffinity_2_3_3, sched_setaffinity@GLIBC_2.3.3, remove
sched_setaffinity_2_3_3: .quad 0
.balign 8
.globl sched_setaffinity_2_3_4
.type sched_setaffinity_2_3_4, %function
.symver sched_setaffinity_2_3_4, sched_setaffinity@@GLIBC_2.3.4, remove
sched_setaffinity_2_3_4: .quad 0
.balign 8
.globl copysignf_2_2_5
.type copysignf_2_2_5, %function
.symver copysignf_2_2_5, copysignf@@GLIBC_2.2.5, remove
copysignf_2_2_5: .quad 0
.balign 8
.globl vfwprintf_2_2_5
.type vfwprintf_2_2_5, %function
.symver vfwprintf_2_2_5, vfwprintf@@GLIBC_2.2.5, remove
vfwprintf_2_2_5: .quad 0
.balign 8
.globl backtrace_2_2_5
.type backtrace_2_2_5, %function
.symver backtrace_2_2_5, backtrace@@GLIBC_2.2.5, remove
backtrace_2_2_5: .quad 0
.balign 8
.globl makecontext_2_2_5
.type makecontext_2_2_5, %function
.symver makecontext_2_2_5, makecontext@@GLIBC_2.2.5, remove
makecontext_2_2_5: .quad 0
.balign 8
.globl __strcoll_l_2_2_5
.type __strcoll_l_2_2_5, %function
.symver __strcoll_l_2_2_5, __strcoll_l@@GLIBC_2.2.5, remove
__strcoll_l_2_2_5: .quad 0
.balign 8
.globl tcflush_2_2_5
.type tcflush_2_2_5, %function
.symver tcflush_2_2_5, tcflush@@GLIBC_2.2.5, remove
tcflush_2_2_5: .quad 0
.balign 8
.globl warnx_2_2_5
.type warnx_2_2_5, %function
.symver warnx_2_2_5, warnx@@GLIBC_2.2.5, remove
warnx_2_2_5: .quad 0
.balign 8
.globl __readlink_chk_2_4
.type __readlink_chk_2_4, %function
.symver __readlink_chk_2_4, __readlink_chk@@GLIBC_2.4, remove
__readlink_chk_2_4: .quad 0
.balign 8
.globl globfree64_2_2_5
.type globfree64_2_2_5, %function
.symver globfree64_2_2_5, globfree64@@GLIBC_2.2.5, remove
globfree64_2_2_5: .quad 0
.balign 8
.globl __xpg_strerror_r_2_3_4
.type __xpg_strerror_r_2_3_4, %function
.symver __xpg_strerror_r_2_3_4, __xpg_strerror_r@@GLIBC_2.3.4, remove
__xpg_strerror_r_2_3_4: .quad 0
.balign 8
.globl vdprintf_2_2_5
.type vdprintf_2_2_5, %function
.symver vdprintf_2_2_5, vdprintf@@GLIBC_2.2.5, remove
vdprintf_2_2_5: .quad 0
.balign 8
.globl __select_2_2_5
.type __select_2_2_5, %function
.symver __select_2_2_5, __select@@GLIBC_2.2.5, remove
__select_2_2_5: .quad 0
.balign 8
.globl __arch_prctl_2_2_5
.type __arch_prctl_2_2_5, %function
.symver __arch_prctl_2_2_5, __arch_prctl@@GLIBC_2.2.5, remove
__arch_prctl_2_2_5: .quad 0
.balign 8
.globl _IO_fopen_2_2_5
.type _IO_fopen_2_2_5, %function
.symver _IO_fopen_2_2_5, _IO_fopen@@GLIBC_2.2.5, remove
_IO_fopen_2_2_5: .quad 0
.balign 8
.globl strtod_l_2_3
.type strtod_l_2_3, %function
.symver strtod_l_2_3, strtod_l@@GLIBC_2.3, remove
strtod_l_2_3: .quad 0
.balign 8
.globl __isoc99_fscanf_2_7
.type __isoc99_fscanf_2_7, %function
.symver __isoc99_fscanf_2_7, __isoc99_fscanf@@GLIBC_2.7, remove
__isoc99_fscanf_2_7: .quad 0
.balign 8
.globl _IO_adjust_column_2_2_5
.type _IO_adjust_column_2_2_5, %function
.symver _IO_adjust_column_2_2_5, _IO_adjust_column@@GLIBC_2.2.5, remove
_IO_adjust_column_2_2_5: .quad 0
.balign 8
.globl __signbitf_2_2_5
.type __signbitf_2_2_5, %function
.symver __signbitf_2_2_5, __signbitf@@GLIBC_2.2.5, remove
__signbitf_2_2_5: .quad 0
.balign 8
.globl __memset_chk_2_3_4
.type __memset_chk_2_3_4, %function
.symver __memset_chk_2_3_4, __memset_chk@@GLIBC_2.3.4, remove
__memset_chk_2_3_4: .quad 0
.balign 8
.globl hasmntopt_2_2_5
.type hasmntopt_2_2_5, %function
.symver hasmntopt_2_2_5, hasmntopt@@GLIBC_2.2.5, remove
hasmntopt_2_2_5: .quad 0
.balign 8
.globl wcsncat_2_2_5
.type wcsncat_2_2_5, %function
.symver wcsncat_2_2_5, wcsncat@@GLIBC_2.2.5, remove
wcsncat_2_2_5: .quad 0
.balign 8
.globl bindtextdomain_2_2_5
.type bindtextdomain_2_2_5, %function
.symver bindtextdomain_2_2_5, bindtextdomain@@GLIBC_2.2.5, remove
bindtextdomain_2_2_5: .quad 0
.balign 8
.globl alphasort_2_2_5
.type alphasort_2_2_5, %function
.symver alphasort_2_2_5, alphasort@@GLIBC_2.2.5, remove
alphasort_2_2_5: .quad 0
.balign 8
.globl clock_2_2_5
.type clock_2_2_5, %function
.symver clock_2_2_5, clock@@GLIBC_2.2.5, remove
clock_2_2_5: .quad 0
.balign 8
.globl __tolower_l_2_2_5
.type __tolower_l_2_2_5, %function
.symver __tolower_l_2_2_5, __tolower_l@@GLIBC_2.2.5, remove
__tolower_l_2_2_5: .quad 0
.balign 8
.globl _IO_wfile_underflow_2_2_5
.type _IO_wfile_underflow_2_2_5, %function
.symver _IO_wfile_underflow_2_2_5, _IO_wfile_underflow@@GLIBC_2.2.5, remove
_IO_wfile_underflow_2_2_5: .quad 0
.balign 8
.globl __sysctl_2_2_5
.type __sysctl_2_2_5, %function
.symver __sysctl_2_2_5, __sysctl@@GLIBC_2.2.5, remove
__sysctl_2_2_5: .quad 0
.balign 8
.globl _IO_fflush_2_2_5
.type _IO_fflush_2_2_5, %function
.symver _IO_fflush_2_2_5, _IO_fflush@@GLIBC_2.2.5, remove
_IO_fflush_2_2_5: .quad 0
.balign 8
.globl register_printf_specifier_2_10
.type register_printf_specifier_2_10, %function
.symver register_printf_specifier_2_10, register_printf_specifier@@GLIBC_2.10, remove
register_printf_specifier_2_10: .quad 0
.balign 8
.globl mblen_2_2_5
.type mblen_2_2_5, %function
.symver mblen_2_2_5, mblen@@GLIBC_2.2.5, remove
mblen_2_2_5: .quad 0
.balign 8
.globl iswdigit_2_2_5
.type iswdigit_2_2_5, %function
.symver iswdigit_2_2_5, iswdigit@@GLIBC_2.2.5, remove
iswdigit_2_2_5: .quad 0
.balign 8
.globl _IO_init_marker_2_2_5
.type _IO_init_marker_2_2_5, %function
.symver _IO_init_marker_2_2_5, _IO_init_marker@@GLIBC_2.2.5, remove
_IO_init_marker_2_2_5: .quad 0
.balign 8
.globl readahead_2_3
.type readahead_2_3, %function
.symver readahead_2_3, readahead@@GLIBC_2.3, remove
readahead_2_3: .quad 0
.balign 8
.globl xdr_cryptkeyres_2_2_5
.type xdr_cryptkeyres_2_2_5, %function
.symver xdr_cryptkeyres_2_2_5, xdr_cryptkeyres@@GLIBC_2.2.5, remove
xdr_cryptkeyres_2_2_5: .quad 0
.balign 8
.globl epoll_create1_2_9
.type epoll_create1_2_9, %function
.symver epoll_create1_2_9, epoll_create1@@GLIBC_2.9, remove
epoll_create1_2_9: .quad 0
.balign 8
.globl _dl_mcount_wrapper_check_2_2_5
.type _dl_mcount_wrapper_check_2_2_5, %function
.symver _dl_mcount_wrapper_check_2_2_5, _dl_mcount_wrapper_check@@GLIBC_2.2.5, remove
_dl_mcount_wrapper_check_2_2_5: .quad 0
.balign 8
.globl getutent_2_2_5
.type getutent_2_2_5, %function
.symver getutent_2_2_5, getutent@@GLIBC_2.2.5, remove
getutent_2_2_5: .quad 0
.balign 8
.globl svc_unregister_2_2_5
.type svc_unregister_2_2_5, %function
.symver svc_unregister_2_2_5, svc_unregister@@GLIBC_2.2.5, remove
svc_unregister_2_2_5: .quad 0
.balign 8
.globl __isoc99_vfwscanf_2_7
.type __isoc99_vfwscanf_2_7, %function
.symver __isoc99_vfwscanf_2_7, __isoc99_vfwscanf@@GLIBC_2.7, remove
__isoc99_vfwscanf_2_7: .quad 0
.balign 8
.globl memcpy_2_2_5
.type memcpy_2_2_5, %function
.symver memcpy_2_2_5, memcpy@GLIBC_2.2.5, remove
memcpy_2_2_5: .quad 0
.balign 8
.globl memcpy_2_14
.type memcpy_2_14, %function
.symver memcpy_2_14, memcpy@@GLIBC_2.14, remove
memcpy_2_14: .quad 0
.balign 8
.globl setresuid_2_2_5
.type setresuid_2_2_5, %function
.symver setresuid_2_2_5, setresuid@@GLIBC_2.2.5, remove
setresuid_2_2_5: .quad 0
.balign 8
.globl setlocale_2_2_5
.type setlocale_2_2_5, %function
.symver setlocale_2_2_5, setlocale@@GLIBC_2.2.5, remove
setlocale_2_2_5: .quad 0
.balign 8
.globl __backtrace_2_2_5
.type __backtrace_2_2_5, %function
.symver __backtrace_2_2_5, __backtrace@@GLIBC_2.2.5, remove
__backtrace_2_2_5: .quad 0
.balign 8
.globl argz_next_2_2_5
.type argz_next_2_2_5, %function
.symver argz_next_2_2_5, argz_next@@GLIBC_2.2.5, remove
argz_next_2_2_5: .quad 0
.balign 8
.globl moncontrol_2_2_5
.type moncontrol_2_2_5, %function
.symver moncontrol_2_2_5, moncontrol@@GLIBC_2.2.5, remove
moncontrol_2_2_5: .quad 0
.balign 8
.globl clock_adjtime_2_14
.type clock_adjtime_2_14, %function
.symver clock_adjtime_2_14, clock_adjtime@@GLIBC_2.14, remove
clock_adjtime_2_14: .quad 0
.balign 8
.globl getwc_2_2_5
.type getwc_2_2_5, %function
.symver getwc_2_2_5, getwc@@GLIBC_2.2.5, remove
getwc_2_2_5: .quad 0
.balign 8
.globl openlog_2_2_5
.type openlog_2_2_5, %function
.symver openlog_2_2_5, openlog@@GLIBC_2.2.5, remove
openlog_2_2_5: .quad 0
.balign 8
.globl wcrtomb_2_2_5
.type wcrtomb_2_2_5, %function
.symver wcrtomb_2_2_5, wcrtomb@@GLIBC_2.2.5, remove
wcrtomb_2_2_5: .quad 0
.balign 8
.globl sched_getparam_2_2_5
.type sched_getparam_2_2_5, %function
.symver sched_getparam_2_2_5, sched_getparam@@GLIBC_2.2.5, remove
sched_getparam_2_2_5: .quad 0
.balign 8
.globl __isblank_l_2_2_5
.type __isblank_l_2_2_5, %function
.symver __isblank_l_2_2_5, __isblank_l@@GLIBC_2.2.5, remove
__isblank_l_2_2_5: .quad 0
.balign 8
.globl fdopendir_2_4
.type fdopendir_2_4, %function
.symver fdopendir_2_4, fdopendir@@GLIBC_2.4, remove
fdopendir_2_4: .quad 0
.balign 8
.globl chown_2_2_5
.type chown_2_2_5, %function
.symver chown_2_2_5, chown@@GLIBC_2.2.5, remove
chown_2_2_5: .quad 0
.balign 8
.globl secure_getenv_2_17
.type secure_getenv_2_17, %function
.symver secure_getenv_2_17, secure_getenv@@GLIBC_2.17, remove
secure_getenv_2_17: .quad 0
.balign 8
.globl __sched_cpufree_2_7
.type __sched_cpufree_2_7, %function
.symver __sched_cpufree_2_7, __sched_cpufree@@GLIBC_2.7, remove
__sched_cpufree_2_7: .quad 0
.balign 8
.globl hdestroy_r_2_2_5
.type hdestroy_r_2_2_5, %function
.symver hdestroy_r_2_2_5, hdestroy_r@@GLIBC_2.2.5, remove
hdestroy_r_2_2_5: .quad 0
.balign 8
.globl _IO_do_write_2_2_5
.type _IO_do_write_2_2_5, %function
.symver _IO_do_write_2_2_5, _IO_do_write@@GLIBC_2.2.5, remove
_IO_do_write_2_2_5: .quad 0
.balign 8
.globl endhostent_2_2_5
.type endhostent_2_2_5, %function
.symver endhostent_2_2_5, endhostent@@GLIBC_2.2.5, remove
endhostent_2_2_5: .quad 0
.balign 8
.globl sigorset_2_2_5
.type sigorset_2_2_5, %function
.symver sigorset_2_2_5, sigorset@@GLIBC_2.2.5, remove
sigorset_2_2_5: .quad 0
.balign 8
.globl stpcpy_2_2_5
.type stpcpy_2_2_5, %function
.symver stpcpy_2_2_5, stpcpy@@GLIBC_2.2.5, remove
stpcpy_2_2_5: .quad 0
.balign 8
.globl __fpurge_2_2_5
.type __fpurge_2_2_5, %function
.symver __fpurge_2_2_5, __fpurge@@GLIBC_2.2.5, remove
__fpurge_2_2_5: .quad 0
.balign 8
.globl __fork_2_2_5
.type __fork_2_2_5, %function
.symver __fork_2_2_5, __fork@@GLIBC_2.2.5, remove
__fork_2_2_5: .quad 0
.balign 8
.globl __send_2_2_5
.type __send_2_2_5, %function
.symver __send_2_2_5, __send@@GLIBC_2.2.5, remove
__send_2_2_5: .quad 0
.balign 8
.globl xdrstdio_create_2_2_5
.type xdrstdio_create_2_2_5, %function
.symver xdrstdio_create_2_2_5, xdrstdio_create@@GLIBC_2.2.5, remove
xdrstdio_create_2_2_5: .quad 0
.balign 8
.globl fdetach_2_2_5
.type fdetach_2_2_5, %function
.symver fdetach_2_2_5, fdetach@@GLIBC_2.2.5, remove
fdetach_2_2_5: .quad 0
.balign 8
.globl __wcscpy_chk_2_4
.type __wcscpy_chk_2_4, %function
.symver __wcscpy_chk_2_4, __wcscpy_chk@@GLIBC_2.4, remove
__wcscpy_chk_2_4: .quad 0
.balign 8
.globl vscanf_2_2_5
.type vscanf_2_2_5, %function
.symver vscanf_2_2_5, vscanf@@GLIBC_2.2.5, remove
vscanf_2_2_5: .quad 0
.balign 8
.globl gmtime_2_2_5
.type gmtime_2_2_5, %function
.symver gmtime_2_2_5, gmtime@@GLIBC_2.2.5, remove
gmtime_2_2_5: .quad 0
.balign 8
.globl execvp_2_2_5
.type execvp_2_2_5, %function
.symver execvp_2_2_5, execvp@@GLIBC_2.2.5, remove
execvp_2_2_5: .quad 0
.balign 8
.globl setstate_2_2_5
.type setstate_2_2_5, %function
.symver setstate_2_2_5, setstate@@GLIBC_2.2.5, remove
setstate_2_2_5: .quad 0
.balign 8
.globl __fbufsize_2_2_5
.type __fbufsize_2_2_5, %function
.symver __fbufsize_2_2_5, __fbufsize@@GLIBC_2.2.5, remove
__fbufsize_2_2_5: .quad 0
.balign 8
.globl __ffs_2_2_5
.type __ffs_2_2_5, %function
.symver __ffs_2_2_5, __ffs@@GLIBC_2.2.5, remove
__ffs_2_2_5: .quad 0
.balign 8
.globl __mbstowcs_chk_2_4
.type __mbstowcs_chk_2_4, %function
.symver __mbstowcs_chk_2_4, __mbstowcs_chk@@GLIBC_2.4, remove
__mbstowcs_chk_2_4: .quad 0
.balign 8
.globl hsearch_r_2_2_5
.type hsearch_r_2_2_5, %function
.symver hsearch_r_2_2_5, hsearch_r@@GLIBC_2.2.5, remove
hsearch_r_2_2_5: .quad 0
.balign 8
.globl __res_init_2_2_5
.type __res_init_2_2_5, %function
.symver __res_init_2_2_5, __res_init@@GLIBC_2.2.5, remove
__res_init_2_2_5: .quad 0
.balign 8
.globl mcheck_pedantic_2_2_5
.type mcheck_pedantic_2_2_5, %function
.symver mcheck_pedantic_2_2_5, mcheck_pedantic@@GLIBC_2.2.5, remove
mcheck_pedantic_2_2_5: .quad 0
.balign 8
.globl wcstoull_2_2_5
.type wcstoull_2_2_5, %function
.symver wcstoull_2_2_5, wcstoull@@GLIBC_2.2.5, remove
wcstoull_2_2_5: .quad 0
.balign 8
.globl wcscasecmp_l_2_3
.type wcscasecmp_l_2_3, %function
.symver wcscasecmp_l_2_3, wcscasecmp_l@@GLIBC_2.3, remove
wcscasecmp_l_2_3: .quad 0
.balign 8
.globl quick_exit_2_10
.type quick_exit_2_10, %function
.symver quick_exit_2_10, quick_exit@@GLIBC_2.10, remove
quick_exit_2_10: .quad 0
.balign 8
.globl getutxline_2_2_5
.type getutxline_2_2_5, %function
.symver getutxline_2_2_5, getutxline@@GLIBC_2.2.5, remove
getutxline_2_2_5: .quad 0
.balign 8
.globl __asprintf_2_2_5
.type __asprintf_2_2_5, %function
.symver __asprintf_2_2_5, __asprintf@@GLIBC_2.2.5, remove
__asprintf_2_2_5: .quad 0
.balign 8
.globl strtok_2_2_5
.type strtok_2_2_5, %function
.symver strtok_2_2_5, strtok@@GLIBC_2.2.5, remove
strtok_2_2_5: .quad 0
.balign 8
.globl recvfrom_2_2_5
.type recvfrom_2_2_5, %function
.symver recvfrom_2_2_5, recvfrom@@GLIBC_2.2.5, remove
recvfrom_2_2_5: .quad 0
.balign 8
.globl __iswxdigit_l_2_2_5
.type __iswxdigit_l_2_2_5, %function
.symver __iswxdigit_l_2_2_5, __iswxdigit_l@@GLIBC_2.2.5, remove
__iswxdigit_l_2_2_5: .quad 0
.balign 8
.globl brk_2_2_5
.type brk_2_2_5, %function
.symver brk_2_2_5, brk@@GLIBC_2.2.5, remove
brk_2_2_5: .quad 0
.balign 8
.globl realpath_2_2_5
.type realpath_2_2_5, %function
.symver realpath_2_2_5, realpath@GLIBC_2.2.5, remove
realpath_2_2_5: .quad 0
.balign 8
.globl realpath_2_3
.type realpath_2_3, %function
.symver realpath_2_3, realpath@@GLIBC_2.3, remove
realpath_2_3: .quad 0
.balign 8
.globl setenv_2_2_5
.type setenv_2_2_5, %function
.symver setenv_2_2_5, setenv@@GLIBC_2.2.5, remove
setenv_2_2_5: .quad 0
.balign 8
.globl __vasprintf_chk_2_8
.type __vasprintf_chk_2_8, %function
.symver __vasprintf_chk_2_8, __vasprintf_chk@@GLIBC_2.8, remove
__vasprintf_chk_2_8: .quad 0
.balign 8
.globl killpg_2_2_5
.type killpg_2_2_5, %function
.symver killpg_2_2_5, killpg@@GLIBC_2.2.5, remove
killpg_2_2_5: .quad 0
.balign 8
.globl klogctl_2_2_5
.type klogctl_2_2_5, %function
.symver klogctl_2_2_5, klogctl@@GLIBC_2.2.5, remove
klogctl_2_2_5: .quad 0
.balign 8
.globl wcwidth_2_2_5
.type wcwidth_2_2_5, %function
.symver wcwidth_2_2_5, wcwidth@@GLIBC_2.2.5, remove
wcwidth_2_2_5: .quad 0
.balign 8
.globl __isoc99_scanf_2_7
.type __isoc99_scanf_2_7, %function
.symver __isoc99_scanf_2_7, __isoc99_scanf@@GLIBC_2.7, remove
__isoc99_scanf_2_7: .quad 0
.balign 8
.globl getauxval_2_16
.type getauxval_2_16, %function
.symver getauxval_2_16, getauxval@@GLIBC_2.16, remove
getauxval_2_16: .quad 0
.balign 8
.globl __strxfrm_l_2_2_5
.type __strxfrm_l_2_2_5, %function
.symver __strxfrm_l_2_2_5, __strxfrm_l@@GLIBC_2.2.5, remove
__strxfrm_l_2_2_5: .quad 0
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
.globl gsignal_2_2_5
.type gsignal_2_2_5, %function
.symver gsignal_2_2_5, gsignal@@GLIBC_2.2.5, remove
gsignal_2_2_5: .quad 0
.balign 8
.globl tcflow_2_2_5
.type tcflow_2_2_5, %function
.symver tcflow_2_2_5, tcflow@@GLIBC_2.2.5, remove
tcflow_2_2_5: .quad 0
.balign 8
.globl mcheck_check_all_2_2_5
.type mcheck_check_all_2_2_5, %function
.symver mcheck_check_all_2_2_5, mcheck_check_all@@GLIBC_2.2.5, remove
mcheck_check_all_2_2_5: .quad 0
.balign 8
.globl group_member_2_2_5
.type group_member_2_2_5, %function
.symver group_member_2_2_5, group_member@@GLIBC_2.2.5, remove
group_member_2_2_5: .quad 0
.balign 8
.globl re_compile_pattern_2_2_5
.type re_compile_pattern_2_2_5, %function
.symver re_compile_pattern_2_2_5, re_compile_pattern@@GLIBC_2.2.5, remove
re_compile_pattern_2_2_5: .quad 0
.balign 8
.globl __nss_next_2_2_5
.type __nss_next_2_2_5, %function
.symver __nss_next_2_2_5, __nss_next@@GLIBC_2.2.5, remove
__nss_next_2_2_5: .quad 0
.balign 8
.globl isfdtype_2_2_5
.type isfdtype_2_2_5, %function
.symver isfdtype_2_2_5, isfdtype@@GLIBC_2.2.5, remove
isfdtype_2_2_5: .quad 0
.balign 8
.globl modfl_2_2_5
.type modfl_2_2_5, %function
.symver modfl_2_2_5, modfl@@GLIBC_2.2.5, remove
modfl_2_2_5: .quad 0
.balign 8
.globl _obstack_begin_2_2_5
.type _obstack_begin_2_2_5, %function
.symver _obstack_begin_2_2_5, _obstack_begin@@GLIBC_2.2.5, remove
_obstack_begin_2_2_5: .quad 0
.balign 8
.globl inet6_opt_get_val_2_5
.type inet6_opt_get_val_2_5, %function
.symver inet6_opt_get_val_2_5, inet6_opt_get_val@@GLIBC_2.5, remove
inet6_opt_get_val_2_5: .quad 0
.balign 8
.globl truncate_2_2_5
.type truncate_2_2_5, %function
.symver truncate_2_2_5, truncate@@GLIBC_2.2.5, remove
truncate_2_2_5: .quad 0
.balign 8
.globl rindex_2_2_5
.type rindex_2_2_5, %function
.symver rindex_2_2_5, rindex@@GLIBC_2.2.5, remove
rindex_2_2_5: .quad 0
.balign 8
.globl strsignal_2_2_5
.type strsignal_2_2_5, %function
.symver strsignal_2_2_5, strsignal@@GLIBC_2.2.5, remove
strsignal_2_2_5: .quad 0
.balign 8
.globl ulimit_2_2_5
.type ulimit_2_2_5, %function
.symver ulimit_2_2_5, ulimit@@GLIBC_2.2.5, remove
ulimit_2_2_5: .quad 0
.balign 8
.globl des_setparity_2_2_5
.type des_setparity_2_2_5, %function
.symver des_setparity_2_2_5, des_setparity@@GLIBC_2.2.5, remove
des_setparity_2_2_5: .quad 0
.balign 8
.globl isascii_2_2_5
.type isascii_2_2_5, %function
.symver isascii_2_2_5, isascii@@GLIBC_2.2.5, remove
isascii_2_2_5: .quad 0
.balign 8
.globl putsgent_2_10
.type putsgent_2_10, %function
.symver putsgent_2_10, putsgent@@GLIBC_2.10, remove
putsgent_2_10: .quad 0
.balign 8
.globl sigpending_2_2_5
.type sigpending_2_2_5, %function
.symver sigpending_2_2_5, sigpending@@GLIBC_2.2.5, remove
sigpending_2_2_5: .quad 0
.balign 8
.globl process_vm_writev_2_15
.type process_vm_writev_2_15, %function
.symver process_vm_writev_2_15, process_vm_writev@@GLIBC_2.15, remove
process_vm_writev_2_15: .quad 0
.balign 8
.globl swscanf_2_2_5
.type swscanf_2_2_5, %function
.symver swscanf_2_2_5, swscanf@@GLIBC_2.2.5, remove
swscanf_2_2_5: .quad 0
.balign 8
.globl ttyname_2_2_5
.type ttyname_2_2_5, %function
.symver ttyname_2_2_5, ttyname@@GLIBC_2.2.5, remove
ttyname_2_2_5: .quad 0
.balign 8
.globl getdate_r_2_2_5
.type getdate_r_2_2_5, %function
.symver getdate_r_2_2_5, getdate_r@@GLIBC_2.2.5, remove
getdate_r_2_2_5: .quad 0
.balign 8
.globl readlinkat_2_4
.type readlinkat_2_4, %function
.symver readlinkat_2_4, readlinkat@@GLIBC_2.4, remove
readlinkat_2_4: .quad 0
.balign 8
.globl __dgettext_2_2_5
.type __dgettext_2_2_5, %function
.symver __dgettext_2_2_5, __dgettext@@GLIBC_2.2.5, remove
__dgettext_2_2_5: .quad 0
.balign 8
.globl nfsservctl_2_2_5
.type nfsservctl_2_2_5, %function
.symver nfsservctl_2_2_5, nfsservctl@@GLIBC_2.2.5, remove
nfsservctl_2_2_5: .quad 0
.balign 8
.globl __strcpy_chk_2_3_4
.type __strcpy_chk_2_3_4, %function
.symver __strcpy_chk_2_3_4, __strcpy_chk@@GLIBC_2.3.4, remove
__strcpy_chk_2_3_4: .quad 0
.balign 8
.globl atof_2_2_5
.type atof_2_2_5, %function
.symver atof_2_2_5, atof@@GLIBC_2.2.5, remove
atof_2_2_5: .quad 0
.balign 8
.globl ether_aton_2_2_5
.type ether_aton_2_2_5, %function
.symver ether_aton_2_2_5, ether_aton@@GLIBC_2.2.5, remove
ether_aton_2_2_5: .quad 0
.balign 8
.globl gnu_get_libc_version_2_2_5
.type gnu_get_libc_version_2_2_5, %function
.symver gnu_get_libc_version_2_2_5, gnu_get_libc_version@@GLIBC_2.2.5, remove
gnu_get_libc_version_2_2_5: .quad 0
.balign 8
.globl div_2_2_5
.type div_2_2_5, %function
.symver div_2_2_5, div@@GLIBC_2.2.5, remove
div_2_2_5: .quad 0
.balign 8
.globl mkdirat_2_4
.type mkdirat_2_4, %function
.symver mkdirat_2_4, mkdirat@@GLIBC_2.4, remove
mkdirat_2_4: .quad 0
.balign 8
.globl tsearch_2_2_5
.type tsearch_2_2_5, %function
.symver tsearch_2_2_5, tsearch@@GLIBC_2.2.5, remove
tsearch_2_2_5: .quad 0
.balign 8
.globl updwtmp_2_2_5
.type updwtmp_2_2_5, %function
.symver updwtmp_2_2_5, updwtmp@@GLIBC_2.2.5, remove
updwtmp_2_2_5: .quad 0
.balign 8
.globl __sched_get_priority_max_2_2_5
.type __sched_get_priority_max_2_2_5, %function
.symver __sched_get_priority_max_2_2_5, __sched_get_priority_max@@GLIBC_2.2.5, remove
__sched_get_priority_max_2_2_5: .quad 0
.balign 8
.globl sstk_2_2_5
.type sstk_2_2_5, %function
.symver sstk_2_2_5, sstk@@GLIBC_2.2.5, remove
sstk_2_2_5: .quad 0
.balign 8
.globl _IO_getc_2_2_5
.type _IO_getc_2_2_5, %function
.symver _IO_getc_2_2_5, _IO_getc@@GLIBC_2.2.5, remove
_IO_getc_2_2_5: .quad 0
.balign 8
.globl xdr_getcredres_2_2_5
.type xdr_getcredres_2_2_5, %function
.symver xdr_getcredres_2_2_5, xdr_getcredres@@GLIBC_2.2.5, remove
xdr_getcredres_2_2_5: .quad 0
.balign 8
.globl host2netname_2_2_5
.type host2netname_2_2_5, %function
.symver host2netname_2_2_5, host2netname@@GLIBC_2.2.5, remove
host2netname_2_2_5: .quad 0
.balign 8
.globl getlogin_r_2_2_5
.type getlogin_r_2_2_5, %function
.symver getlogin_r_2_2_5, getlogin_r@@GLIBC_2.2.5, remove
getlogin_r_2_2_5: .quad 0
.balign 8
.globl posix_spawnattr_destroy_2_2_5
.type posix_spawnattr_destroy_2_2_5, %function
.symver posix_spawnattr_destroy_2_2_5, posix_spawnattr_destroy@@GLIBC_2.2.5, remove
posix_spawnattr_destroy_2_2_5: .quad 0
.balign 8
.globl finitel_2_2_5
.type finitel_2_2_5, %function
.symver finitel_2_2_5, finitel@@GLIBC_2.2.5, remove
finitel_2_2_5: .quad 0
.balign 8
.globl cfsetispeed_2_2_5
.type cfsetispeed_2_2_5, %function
.symver cfsetispeed_2_2_5, cfsetispeed@@GLIBC_2.2.5, remove
cfsetispeed_2_2_5: .quad 0
.balign 8
.globl _IO_file_open_2_2_5
.type _IO_file_open_2_2_5, %function
.symver _IO_file_open_2_2_5, _IO_file_open@@GLIBC_2.2.5, remove
_IO_file_open_2_2_5: .quad 0
.balign 8
.globl strcasecmp_2_2_5
.type strcasecmp_2_2_5, %function
.symver strcasecmp_2_2_5, strcasecmp@@GLIBC_2.2.5, remove
strcasecmp_2_2_5: .quad 0
.balign 8
.globl getprotobyname_2_2_5
.type getprotobyname_2_2_5, %function
.symver getprotobyname_2_2_5, getprotobyname@@GLIBC_2.2.5, remove
getprotobyname_2_2_5: .quad 0
.balign 8
.globl gethostbyname2_2_2_5
.type gethostbyname2_2_2_5, %function
.symver gethostbyname2_2_2_5, gethostbyname2@@GLIBC_2.2.5, remove
gethostbyname2_2_2_5: .quad 0
.balign 8
.globl _IO_sungetc_2_2_5
.type _IO_sungetc_2_2_5, %function
.symver _IO_sungetc_2_2_5, _IO_sungetc@@GLIBC_2.2.5, remove
_IO_sungetc_2_2_5: .quad 0
.balign 8
.globl getprotoent_2_2_5
.type getprotoent_2_2_5, %function
.symver getprotoent_2_2_5, getprotoent@@GLIBC_2.2.5, remove
getprotoent_2_2_5: .quad 0
.balign 8
.globl inet6_opt_next_2_5
.type inet6_opt_next_2_5, %function
.symver inet6_opt_next_2_5, inet6_opt_next@@GLIBC_2.5, remove
inet6_opt_next_2_5: .quad 0
.balign 8
.globl svc_getreq_2_2_5
.type svc_getreq_2_2_5, %function
.symver svc_getreq_2_2_5, svc_getreq@@GLIBC_2.2.5, remove
svc_getreq_2_2_5: .quad 0
.balign 8
.globl getutent_r_2_2_5
.type getutent_r_2_2_5, %function
.symver getutent_r_2_2_5, getutent_r@@GLIBC_2.2.5, remove
getutent_r_2_2_5: .quad 0
.balign 8
.globl __strtof_l_2_2_5
.type __strtof_l_2_2_5, %function
.symver __strtof_l_2_2_5, __strtof_l@@GLIBC_2.2.5, remove
__strtof_l_2_2_5: .quad 0
.balign 8
.globl iconv_close_2_2_5
.type iconv_close_2_2_5, %function
.symver iconv_close_2_2_5, iconv_close@@GLIBC_2.2.5, remove
iconv_close_2_2_5: .quad 0
.balign 8
.globl __argz_next_2_2_5
.type __argz_next_2_2_5, %function
.symver __argz_next_2_2_5, __argz_next@@GLIBC_2.2.5, remove
__argz_next_2_2_5: .quad 0
.balign 8
.globl pmap_getmaps_2_2_5
.type pmap_getmaps_2_2_5, %function
.symver pmap_getmaps_2_2_5, pmap_getmaps@@GLIBC_2.2.5, remove
pmap_getmaps_2_2_5: .quad 0
.balign 8
.globl wcstoll_l_2_3
.type wcstoll_l_2_3, %function
.symver wcstoll_l_2_3, wcstoll_l@@GLIBC_2.3, remove
wcstoll_l_2_3: .quad 0
.balign 8
.globl bsearch_2_2_5
.type bsearch_2_2_5, %function
.symver bsearch_2_2_5, bsearch@@GLIBC_2.2.5, remove
bsearch_2_2_5: .quad 0
.balign 8
.globl __profile_frequency_2_2_5
.type __profile_frequency_2_2_5, %function
.symver __profile_frequency_2_2_5, __profile_frequency@@GLIBC_2.2.5, remove
__profile_frequency_2_2_5: .quad 0
.balign 8
.globl __asprintf_chk_2_8
.type __asprintf_chk_2_8, %function
.symver __asprintf_chk_2_8, __asprintf_chk@@GLIBC_2.8, remove
__asprintf_chk_2_8: .quad 0
.balign 8
.globl xencrypt_2_2_5
.type xencrypt_2_2_5, %function
.symver xencrypt_2_2_5, xencrypt@@GLIBC_2.2.5, remove
xencrypt_2_2_5: .quad 0
.balign 8
.globl __wcstod_l_2_2_5
.type __wcstod_l_2_2_5, %function
.symver __wcstod_l_2_2_5, __wcstod_l@@GLIBC_2.2.5, remove
__wcstod_l_2_2_5: .quad 0
.balign 8
.globl getgrent_r_2_2_5
.type getgrent_r_2_2_5, %function
.symver getgrent_r_2_2_5, getgrent_r@@GLIBC_2.2.5, remove
getgrent_r_2_2_5: .quad 0
.balign 8
.globl setutent_2_2_5
.type setutent_2_2_5, %function
.symver setutent_2_2_5, setutent@@GLIBC_2.2.5, remove
setutent_2_2_5: .quad 0
.balign 8
.globl strtoumax_2_2_5
.type strtoumax_2_2_5, %function
.symver strtoumax_2_2_5, strtoumax@@GLIBC_2.2.5, remove
strtoumax_2_2_5: .quad 0
.balign 8
.globl getrpcbynumber_2_2_5
.type getrpcbynumber_2_2_5, %function
.symver getrpcbynumber_2_2_5, getrpcbynumber@@GLIBC_2.2.5, remove
getrpcbynumber_2_2_5: .quad 0
.balign 8
.globl perror_2_2_5
.type perror_2_2_5, %function
.symver perror_2_2_5, perror@@GLIBC_2.2.5, remove
perror_2_2_5: .quad 0
.balign 8
.globl __strcspn_c1_2_2_5
.type __strcspn_c1_2_2_5, %function
.symver __strcspn_c1_2_2_5, __strcspn_c1@@GLIBC_2.2.5, remove
__strcspn_c1_2_2_5: .quad 0
.balign 8
.globl _IO_getline_2_2_5
.type _IO_getline_2_2_5, %function
.symver _IO_getline_2_2_5, _IO_getline@@GLIBC_2.2.5, remove
_IO_getline_2_2_5: .quad 0
.balign 8
.globl remap_file_pages_2_3_3
.type remap_file_pages_2_3_3, %function
.symver remap_file_pages_2_3_3, remap_file_pages@@GLIBC_2.3.3, remove
remap_file_pages_2_3_3: .quad 0
.balign 8
.globl _IO_adjust_wcolumn_2_2_5
.type _IO_adjust_wcolumn_2_2_5, %function
.symver _IO_adjust_wcolumn_2_2_5, _IO_adjust_wcolumn@@GLIBC_2.2.5, remove
_IO_adjust_wcolumn_2_2_5: .quad 0
.balign 8
.globl wcsncpy_2_2_5
.type wcsncpy_2_2_5, %function
.symver wcsncpy_2_2_5, wcsncpy@@GLIBC_2.2.5, remove
wcsncpy_2_2_5: .quad 0
.balign 8
.globl strptime_2_2_5
.type strptime_2_2_5, %function
.symver strptime_2_2_5, strptime@@GLIBC_2.2.5, remove
strptime_2_2_5: .quad 0
.balign 8
.globl xdr_double_2_2_5
.type xdr_double_2_2_5, %function
.symver xdr_double_2_2_5, xdr_double@@GLIBC_2.2.5, remove
xdr_double_2_2_5: .quad 0
.balign 8
.globl __gmtime_r_2_2_5
.type __gmtime_r_2_2_5, %function
.symver __gmtime_r_2_2_5, __gmtime_r@@GLIBC_2.2.5, remove
__gmtime_r_2_2_5: .quad 0
.balign 8
.globl putwchar_unlocked_2_2_5
.type putwchar_unlocked_2_2_5, %function
.symver putwchar_unlocked_2_2_5, putwchar_unlocked@@GLIBC_2.2.5, remove
putwchar_unlocked_2_2_5: .quad 0
.balign 8
.globl toupper_2_2_5
.type toupper_2_2_5, %function
.symver toupper_2_2_5, toupper@@GLIBC_2.2.5, remove
toupper_2_2_5: .quad 0
.balign 8
.globl getrlimit_2_2_5
.type getrlimit_2_2_5, %function
.symver getrlimit_2_2_5, getrlimit@@GLIBC_2.2.5, remove
getrlimit_2_2_5: .quad 0
.balign 8
.globl towctrans_l_2_3
.type towctrans_l_2_3, %function
.symver towctrans_l_2_3, towctrans_l@@GLIBC_2.3, remove
towctrans_l_2_3: .quad 0
.balign 8
.globl registerrpc_2_2_5
.type registerrpc_2_2_5, %function
.symver registerrpc_2_2_5, registerrpc@@GLIBC_2.2.5, remove
registerrpc_2_2_5: .quad 0
.balign 8
.globl initgroups_2_2_5
.type initgroups_2_2_5, %function
.symver initgroups_2_2_5, initgroups@@GLIBC_2.2.5, remove
initgroups_2_2_5: .quad 0
.balign 8
.globl passwd2des_2_2_5
.type passwd2des_2_2_5, %function
.symver passwd2des_2_2_5, passwd2des@@GLIBC_2.2.5, remove
passwd2des_2_2_5: .quad 0
.balign 8
.globl __iswalpha_l_2_2_5
.type __iswalpha_l_2_2_5, %function
.symver __iswalpha_l_2_2_5, __iswalpha_l@@GLIBC_2.2.5, remove
__iswalpha_l_2_2_5: .quad 0
.balign 8
.globl xdr_key_netstarg_2_2_5
.type xdr_key_netstarg_2_2_5, %function
.symver xdr_key_netstarg_2_2_5, xdr_key_netstarg@@GLIBC_2.2.5, remove
xdr_key_netstarg_2_2_5: .quad 0
.balign 8
.globl profil_2_2_5
.type profil_2_2_5, %function
.symver profil_2_2_5, profil@@GLIBC_2.2.5, remove
profil_2_2_5: .quad 0
.balign 8
.globl xdr_wrapstring_2_2_5
.type xdr_wrapstring_2_2_5, %function
.symver xdr_wrapstring_2_2_5, xdr_wrapstring@@GLIBC_2.2.5, remove
xdr_wrapstring_2_2_5: .quad 0
.balign 8
.globl unlinkat_2_4
.type unlinkat_2_4, %function
.symver unlinkat_2_4, unlinkat@@GLIBC_2.4, remove
unlinkat_2_4: .quad 0
.balign 8
.globl _IO_unsave_markers_2_2_5
.type _IO_unsave_markers_2_2_5, %function
.symver _IO_unsave_markers_2_2_5, _IO_unsave_markers@@GLIBC_2.2.5, remove
_IO_unsave_markers_2_2_5: .quad 0
.balign 8
.globl __vsnprintf_chk_2_3_4
.type __vsnprintf_chk_2_3_4, %function
.symver __vsnprintf_chk_2_3_4, __vsnprintf_chk@@GLIBC_2.3.4, remove
__vsnprintf_chk_2_3_4: .quad 0
.balign 8
.globl sgetspent_2_2_5
.type sgetspent_2_2_5, %function
.symver sgetspent_2_2_5, sgetspent@@GLIBC_2.2.5, remove
sgetspent_2_2_5: .quad 0
.balign 8
.globl strtoull_l_2_3_3
.type strtoull_l_2_3_3, %function
.symver strtoull_l_2_3_3, strtoull_l@@GLIBC_2.3.3, remove
strtoull_l_2_3_3: .quad 0
.balign 8
.globl versionsort64_2_2_5
.type versionsort64_2_2_5, %function
.symver versionsort64_2_2_5, versionsort64@@GLIBC_2.2.5, remove
versionsort64_2_2_5: .quad 0
.balign 8
.globl getpw_2_2_5
.type getpw_2_2_5, %function
.symver getpw_2_2_5, getpw@@GLIBC_2.2.5, remove
getpw_2_2_5: .quad 0
.balign 8
.globl __strncasecmp_l_2_2_5
.type __strncasecmp_l_2_2_5, %function
.symver __strncasecmp_l_2_2_5, __strncasecmp_l@@GLIBC_2.2.5, remove
__strncasecmp_l_2_2_5: .quad 0
.balign 8
.globl ctime_r_2_2_5
.type ctime_r_2_2_5, %function
.symver ctime_r_2_2_5, ctime_r@@GLIBC_2.2.5, remove
ctime_r_2_2_5: .quad 0
.balign 8
.globl posix_spawn_file_actions_addclose_2_2_5
.type posix_spawn_file_actions_addclose_2_2_5, %function
.symver posix_spawn_file_actions_addclose_2_2_5, posix_spawn_file_actions_addclose@@GLIBC_2.2.5, remove
posix_spawn_file_actions_addclose_2_2_5: .quad 0
.balign 8
.globl getitimer_2_2_5
.type getitimer_2_2_5, %function
.symver getitimer_2_2_5, getitimer@@GLIBC_2.2.5, remove
getitimer_2_2_5: .quad 0
.balign 8
.globl catopen_2_2_5
.type catopen_2_2_5, %function
.symver catopen_2_2_5, catopen@@GLIBC_2.2.5, remove
catopen_2_2_5: .quad 0
.balign 8
.globl memmem_2_2_5
.type memmem_2_2_5, %function
.symver memmem_2_2_5, memmem@@GLIBC_2.2.5, remove
memmem_2_2_5: .quad 0
.balign 8
.globl chflags_2_2_5
.type chflags_2_2_5, %function
.symver chflags_2_2_5, chflags@@GLIBC_2.2.5, remove
chflags_2_2_5: .quad 0
.balign 8
.globl __freelocale_2_2_5
.type __freelocale_2_2_5, %function
.symver __freelocale_2_2_5, __freelocale@@GLIBC_2.2.5, remove
__freelocale_2_2_5: .quad 0
.balign 8
.globl fgetgrent_2_2_5
.type fgetgrent_2_2_5, %function
.symver fgetgrent_2_2_5, fgetgrent@@GLIBC_2.2.5, remove
fgetgrent_2_2_5: .quad 0
.balign 8
.globl _IO_fclose_2_2_5
.type _IO_fclose_2_2_5, %function
.symver _IO_fclose_2_2_5, _IO_fclose@@GLIBC_2.2.5, remove
_IO_fclose_2_2_5: .quad 0
.balign 8
.globl __iswupper_l_2_2_5
.type __iswupper_l_2_2_5, %function
.symver __iswupper_l_2_2_5, __iswupper_l@@GLIBC_2.2.5, remove
__iswupper_l_2_2_5: .quad 0
.balign 8
.globl __iswdigit_l_2_2_5
.type __iswdigit_l_2_2_5, %function
.symver __iswdigit_l_2_2_5, __iswdigit_l@@GLIBC_2.2.5, remove
__iswdigit_l_2_2_5: .quad 0
.balign 8
.globl wcstouq_2_2_5
.type wcstouq_2_2_5, %function
.symver wcstouq_2_2_5, wcstouq@@GLIBC_2.2.5, remove
wcstouq_2_2_5: .quad 0
.balign 8
.globl globfree_2_2_5
.type globfree_2_2_5, %function
.symver globfree_2_2_5, globfree@@GLIBC_2.2.5, remove
globfree_2_2_5: .quad 0
.balign 8
.globl _IO_fsetpos64_2_2_5
.type _IO_fsetpos64_2_2_5, %function
.symver _IO_fsetpos64_2_2_5, _IO_fsetpos64@@GLIBC_2.2.5, remove
_IO_fsetpos64_2_2_5: .quad 0
.balign 8
.globl __isoc99_sscanf_2_7
.type __isoc99_sscanf_2_7, %function
.symver __isoc99_sscanf_2_7, __isoc99_sscanf@@GLIBC_2.7, remove
__isoc99_sscanf_2_7: .quad 0
.balign 8
.globl symlinkat_2_4
.type symlinkat_2_4, %function
.symver symlinkat_2_4, symlinkat@@GLIBC_2.4, remove
symlinkat_2_4: .quad 0
.balign 8
.globl _exit_2_2_5
.type _exit_2_2_5, %function
.symver _exit_2_2_5, _exit@@GLIBC_2.2.5, remove
_exit_2_2_5: .quad 0
.balign 8
.globl __isalnum_l_2_2_5
.type __isalnum_l_2_2_5, %function
.symver __isalnum_l_2_2_5, __isalnum_l@@GLIBC_2.2.5, remove
__isalnum_l_2_2_5: .quad 0
.balign 8
.globl xdr_quad_t_2_3_4
.type xdr_quad_t_2_3_4, %function
.symver xdr_quad_t_2_3_4, xdr_quad_t@@GLIBC_2.3.4, remove
xdr_quad_t_2_3_4: .quad 0
.balign 8
.globl __isoc99_vsscanf_2_7
.type __isoc99_vsscanf_2_7, %function
.symver __isoc99_vsscanf_2_7, __isoc99_vsscanf@@GLIBC_2.7, remove
__isoc99_vsscanf_2_7: .quad 0
.balign 8
.globl __cyg_profile_func_exit_2_2_5
.type __cyg_profile_func_exit_2_2_5, %function
.symver __cyg_profile_func_exit_2_2_5, __cyg_profile_func_exit@@GLIBC_2.2.5, remove
__cyg_profile_func_exit_2_2_5: .quad 0
.balign 8
.globl vfprintf_2_2_5
.type vfprintf_2_2_5, %function
.symver vfprintf_2_2_5, vfprintf@@GLIBC_2.2.5, remove
vfprintf_2_2_5: .quad 0
.balign 8
.globl mempcpy_2_2_5
.type mempcpy_2_2_5, %function
.symver mempcpy_2_2_5, mempcpy@@GLIBC_2.2.5, remove
mempcpy_2_2_5: .quad 0
.balign 8
.globl wcsnlen_2_2_5
.type wcsnlen_2_2_5, %function
.symver wcsnlen_2_2_5, wcsnlen@@GLIBC_2.2.5, remove
wcsnlen_2_2_5: .quad 0
.balign 8
.globl _mcleanup_2_2_5
.type _mcleanup_2_2_5, %function
.symver _mcleanup_2_2_5, _mcleanup@@GLIBC_2.2.5, remove
_mcleanup_2_2_5: .quad 0
.balign 8
.globl fts_read_2_2_5
.type fts_read_2_2_5, %function
.symver fts_read_2_2_5, fts_read@@GLIBC_2.2.5, remove
fts_read_2_2_5: .quad 0
.balign 8
.globl chmod_2_2_5
.type chmod_2_2_5, %function
.symver chmod_2_2_5, chmod@@GLIBC_2.2.5, remove
chmod_2_2_5: .quad 0
.balign 8
.globl gai_strerror_2_2_5
.type gai_strerror_2_2_5, %function
.symver gai_strerror_2_2_5, gai_strerror@@GLIBC_2.2.5, remove
gai_strerror_2_2_5: .quad 0
.balign 8
.globl cfgetispeed_2_2_5
.type cfgetispeed_2_2_5, %function
.symver cfgetispeed_2_2_5, cfgetispeed@@GLIBC_2.2.5, remove
cfgetispeed_2_2_5: .quad 0
.balign 8
.globl fputc_unlocked_2_2_5
.type fputc_unlocked_2_2_5, %function
.symver fputc_unlocked_2_2_5, fputc_unlocked@@GLIBC_2.2.5, remove
fputc_unlocked_2_2_5: .quad 0
.balign 8
.globl __libc_calloc_2_2_5
.type __libc_calloc_2_2_5, %function
.symver __libc_calloc_2_2_5, __libc_calloc@@GLIBC_2.2.5, remove
__libc_calloc_2_2_5: .quad 0
.balign 8
.globl wctrans_2_2_5
.type wctrans_2_2_5, %function
.symver wctrans_2_2_5, wctrans@@GLIBC_2.2.5, remove
wctrans_2_2_5: .quad 0
.balign 8
.globl getgrgid_2_2_5
.type getgrgid_2_2_5, %function
.symver getgrgid_2_2_5, getgrgid@@GLIBC_2.2.5, remove
getgrgid_2_2_5: .quad 0
.balign 8
.globl frexp_2_2_5
.type frexp_2_2_5, %function
.symver frexp_2_2_5, frexp@@GLIBC_2.2.5, remove
frexp_2_2_5: .quad 0
.balign 8
.globl xdr_reference_2_2_5
.type xdr_reference_2_2_5, %function
.symver xdr_reference_2_2_5, xdr_reference@@GLIBC_2.2.5, remove
xdr_reference_2_2_5: .quad 0
.balign 8
.globl _IO_file_read_2_2_5
.type _IO_file_read_2_2_5, %function
.symver _IO_file_read_2_2_5, _IO_file_read@@GLIBC_2.2.5, remove
_IO_file_read_2_2_5: .quad 0
.balign 8
.globl lsearch_2_2_5
.type lsearch_2_2_5, %function
.symver lsearch_2_2_5, lsearch@@GLIBC_2.2.5, remove
lsearch_2_2_5: .quad 0
.balign 8
.globl frexpl_2_2_5
.type frexpl_2_2_5, %function
.symver frexpl_2_2_5, frexpl@@GLIBC_2.2.5, remove
frexpl_2_2_5: .quad 0
.balign 8
.globl getc_unlocked_2_2_5
.type getc_unlocked_2_2_5, %function
.symver getc_unlocked_2_2_5, getc_unlocked@@GLIBC_2.2.5, remove
getc_unlocked_2_2_5: .quad 0
.balign 8
.globl msync_2_2_5
.type msync_2_2_5, %function
.symver msync_2_2_5, msync@@GLIBC_2.2.5, remove
msync_2_2_5: .quad 0
.balign 8
.globl hstrerror_2_2_5
.type hstrerror_2_2_5, %function
.symver hstrerror_2_2_5, hstrerror@@GLIBC_2.2.5, remove
hstrerror_2_2_5: .quad 0
.balign 8
.globl obstack_vprintf_2_2_5
.type obstack_vprintf_2_2_5, %function
.symver obstack_vprintf_2_2_5, obstack_vprintf@@GLIBC_2.2.5, remove
obstack_vprintf_2_2_5: .quad 0
.balign 8
.globl __strpbrk_c2_2_2_5
.type __strpbrk_c2_2_2_5, %function
.symver __strpbrk_c2_2_2_5, __strpbrk_c2@@GLIBC_2.2.5, remove
__strpbrk_c2_2_2_5: .quad 0
.balign 8
.globl __strtoull_internal_2_2_5
.type __strtoull_internal_2_2_5, %function
.symver __strtoull_internal_2_2_5, __strtoull_internal@@GLIBC_2.2.5, remove
__strtoull_internal_2_2_5: .quad 0
.balign 8
.globl __ppoll_chk_2_16
.type __ppoll_chk_2_16, %function
.symver __ppoll_chk_2_16, __ppoll_chk@@GLIBC_2.16, remove
__ppoll_chk_2_16: .quad 0
.balign 8
.globl sigprocmask_2_2_5
.type sigprocmask_2_2_5, %function
.symver sigprocmask_2_2_5, sigprocmask@@GLIBC_2.2.5, remove
sigprocmask_2_2_5: .quad 0
.balign 8
.globl mmap64_2_2_5
.type mmap64_2_2_5, %function
.symver mmap64_2_2_5, mmap64@@GLIBC_2.2.5, remove
mmap64_2_2_5: .quad 0
.balign 8
.globl key_decryptsession_pk_2_2_5
.type key_decryptsession_pk_2_2_5, %function
.symver key_decryptsession_pk_2_2_5, key_decryptsession_pk@@GLIBC_2.2.5, remove
key_decryptsession_pk_2_2_5: .quad 0
.balign 8
.globl localtime_2_2_5
.type localtime_2_2_5, %function
.symver localtime_2_2_5, localtime@@GLIBC_2.2.5, remove
localtime_2_2_5: .quad 0
.balign 8
.globl _IO_init_2_2_5
.type _IO_init_2_2_5, %function
.symver _IO_init_2_2_5, _IO_init@@GLIBC_2.2.5, remove
_IO_init_2_2_5: .quad 0
.balign 8
.globl uselocale_2_3
.type uselocale_2_3, %function
.symver uselocale_2_3, uselocale@@GLIBC_2.3, remove
uselocale_2_3: .quad 0
.balign 8
.globl __wcstof_internal_2_2_5
.type __wcstof_internal_2_2_5, %function
.symver __wcstof_internal_2_2_5, __wcstof_internal@@GLIBC_2.2.5, remove
__wcstof_internal_2_2_5: .quad 0
.balign 8
.globl tdestroy_2_2_5
.type tdestroy_2_2_5, %function
.symver tdestroy_2_2_5, tdestroy@@GLIBC_2.2.5, remove
tdestroy_2_2_5: .quad 0
.balign 8
.globl __iswblank_l_2_2_5
.type __iswblank_l_2_2_5, %function
.symver __iswblank_l_2_2_5, __iswblank_l@@GLIBC_2.2.5, remove
__iswblank_l_2_2_5: .quad 0
.balign 8
.globl __read_chk_2_4
.type __read_chk_2_4, %function
.symver __read_chk_2_4, __read_chk@@GLIBC_2.4, remove
__read_chk_2_4: .quad 0
.balign 8
.globl _IO_fdopen_2_2_5
.type _IO_fdopen_2_2_5, %function
.symver _IO_fdopen_2_2_5, _IO_fdopen@@GLIBC_2.2.5, remove
_IO_fdopen_2_2_5: .quad 0
.balign 8
.globl pivot_root_2_2_5
.type pivot_root_2_2_5, %function
.symver pivot_root_2_2_5, pivot_root@@GLIBC_2.2.5, remove
pivot_root_2_2_5: .quad 0
.balign 8
.globl __sched_cpualloc_2_7
.type __sched_cpualloc_2_7, %function
.symver __sched_cpualloc_2_7, __sched_cpualloc@@GLIBC_2.7, remove
__sched_cpualloc_2_7: .quad 0
.balign 8
.globl usleep_2_2_5
.type usleep_2_2_5, %function
.symver usleep_2_2_5, usleep@@GLIBC_2.2.5, remove
usleep_2_2_5: .quad 0
.balign 8
.globl ntp_gettimex_2_12
.type ntp_gettimex_2_12, %function
.symver ntp_gettimex_2_12, ntp_gettimex@@GLIBC_2.12, remove
ntp_gettimex_2_12: .quad 0
.balign 8
.globl get_kernel_syms_2_2_5
.type get_kernel_syms_2_2_5, %function
.symver get_kernel_syms_2_2_5, get_kernel_syms@@GLIBC_2.2.5, remove
get_kernel_syms_2_2_5: .quad 0
.balign 8
.globl _IO_fsetpos_2_2_5
.type _IO_fsetpos_2_2_5, %function
.symver _IO_fsetpos_2_2_5, _IO_fsetpos@@GLIBC_2.2.5, remove
_IO_fsetpos_2_2_5: .quad 0
.balign 8
.globl warn_2_2_5
.type warn_2_2_5, %function
.symver warn_2_2_5, warn@@GLIBC_2.2.5, remove
warn_2_2_5: .quad 0
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
.globl _toupper_2_2_5
.type _toupper_2_2_5, %function
.symver _toupper_2_2_5, _toupper@@GLIBC_2.2.5, remove
_toupper_2_2_5: .quad 0
.balign 8
.globl qgcvt_2_2_5
.type qgcvt_2_2_5, %function
.symver qgcvt_2_2_5, qgcvt@@GLIBC_2.2.5, remove
qgcvt_2_2_5: .quad 0
.balign 8
.globl unshare_2_4
.type unshare_2_4, %function
.symver unshare_2_4, unshare@@GLIBC_2.4, remove
unshare_2_4: .quad 0
.balign 8
.globl writev_2_2_5
.type writev_2_2_5, %function
.symver writev_2_2_5, writev@@GLIBC_2.2.5, remove
writev_2_2_5: .quad 0
.balign 8
.globl mrand48_r_2_2_5
.type mrand48_r_2_2_5, %function
.symver mrand48_r_2_2_5, mrand48_r@@GLIBC_2.2.5, remove
mrand48_r_2_2_5: .quad 0
.balign 8
.globl fflush_2_2_5
.type fflush_2_2_5, %function
.symver fflush_2_2_5, fflush@@GLIBC_2.2.5, remove
fflush_2_2_5: .quad 0
.balign 8
.globl _IO_proc_close_2_2_5
.type _IO_proc_close_2_2_5, %function
.symver _IO_proc_close_2_2_5, _IO_proc_close@@GLIBC_2.2.5, remove
_IO_proc_close_2_2_5: .quad 0
.balign 8
.globl __isoc99_vfscanf_2_7
.type __isoc99_vfscanf_2_7, %function
.symver __isoc99_vfscanf_2_7, __isoc99_vfscanf@@GLIBC_2.7, remove
__isoc99_vfscanf_2_7: .quad 0
.balign 8
.globl fpathconf_2_2_5
.type fpathconf_2_2_5, %function
.symver fpathconf_2_2_5, fpathconf@@GLIBC_2.2.5, remove
fpathconf_2_2_5: .quad 0
.balign 8
.globl sighold_2_2_5
.type sighold_2_2_5, %function
.symver sighold_2_2_5, sighold@@GLIBC_2.2.5, remove
sighold_2_2_5: .quad 0
.balign 8
.globl ldexpl_2_2_5
.type ldexpl_2_2_5, %function
.symver ldexpl_2_2_5, ldexpl@@GLIBC_2.2.5, remove
ldexpl_2_2_5: .quad 0
.balign 8
.globl gettimeofday_2_2_5
.type gettimeofday_2_2_5, %function
.symver gettimeofday_2_2_5, gettimeofday@@GLIBC_2.2.5, remove
gettimeofday_2_2_5: .quad 0
.balign 8
.globl strptime_l_2_3_2
.type strptime_l_2_3_2, %function
.symver strptime_l_2_3_2, strptime_l@@GLIBC_2.3.2, remove
strptime_l_2_3_2: .quad 0
.balign 8
.globl key_get_conv_2_2_5
.type key_get_conv_2_2_5, %function
.symver key_get_conv_2_2_5, key_get_conv@@GLIBC_2.2.5, remove
key_get_conv_2_2_5: .quad 0
.balign 8
.globl tee_2_5
.type tee_2_5, %function
.symver tee_2_5, tee@@GLIBC_2.5, remove
tee_2_5: .quad 0
.balign 8
.globl fwprintf_2_2_5
.type fwprintf_2_2_5, %function
.symver fwprintf_2_2_5, fwprintf@@GLIBC_2.2.5, remove
fwprintf_2_2_5: .quad 0
.balign 8
.globl signal_2_2_5
.type signal_2_2_5, %function
.symver signal_2_2_5, signal@@GLIBC_2.2.5, remove
signal_2_2_5: .quad 0
.balign 8
.globl telldir_2_2_5
.type telldir_2_2_5, %function
.symver telldir_2_2_5, telldir@@GLIBC_2.2.5, remove
telldir_2_2_5: .quad 0
.balign 8
.globl setlinebuf_2_2_5
.type setlinebuf_2_2_5, %function
.symver setlinebuf_2_2_5, setlinebuf@@GLIBC_2.2.5, remove
setlinebuf_2_2_5: .quad 0
.balign 8
.globl __strncpy_chk_2_3_4
.type __strncpy_chk_2_3_4, %function
.symver __strncpy_chk_2_3_4, __strncpy_chk@@GLIBC_2.3.4, remove
__strncpy_chk_2_3_4: .quad 0
.balign 8
.globl isnanl_2_2_5
.type isnanl_2_2_5, %function
.symver isnanl_2_2_5, isnanl@@GLIBC_2.2.5, remove
isnanl_2_2_5: .quad 0
.balign 8
.globl _obstack_memory_used_2_2_5
.type _obstack_memory_used_2_2_5, %function
.symver _obstack_memory_used_2_2_5, _obstack_memory_used@@GLIBC_2.2.5, remove
_obstack_memory_used_2_2_5: .quad 0
.balign 8
.globl __memcpy_chk_2_3_4
.type __memcpy_chk_2_3_4, %function
.symver __memcpy_chk_2_3_4, __memcpy_chk@@GLIBC_2.3.4, remove
__memcpy_chk_2_3_4: .quad 0
.balign 8
.globl lcong48_r_2_2_5
.type lcong48_r_2_2_5, %function
.symver lcong48_r_2_2_5, lcong48_r@@GLIBC_2.2.5, remove
lcong48_r_2_2_5: .quad 0
.balign 8
.globl recvmmsg_2_12
.type recvmmsg_2_12, %function
.symver recvmmsg_2_12, recvmmsg@@GLIBC_2.12, remove
recvmmsg_2_12: .quad 0
.balign 8
.globl seed48_r_2_2_5
.type seed48_r_2_2_5, %function
.symver seed48_r_2_2_5, seed48_r@@GLIBC_2.2.5, remove
seed48_r_2_2_5: .quad 0
.balign 8
.globl wcstoull_l_2_3
.type wcstoull_l_2_3, %function
.symver wcstoull_l_2_3, wcstoull_l@@GLIBC_2.3, remove
wcstoull_l_2_3: .quad 0
.balign 8
.globl err_2_2_5
.type err_2_2_5, %function
.symver err_2_2_5, err@@GLIBC_2.2.5, remove
err_2_2_5: .quad 0
.balign 8
.globl getutline_2_2_5
.type getutline_2_2_5, %function
.symver getutline_2_2_5, getutline@@GLIBC_2.2.5, remove
getutline_2_2_5: .quad 0
.balign 8
.globl getutxid_2_2_5
.type getutxid_2_2_5, %function
.symver getutxid_2_2_5, getutxid@@GLIBC_2.2.5, remove
getutxid_2_2_5: .quad 0
.balign 8
.globl __wcstoull_internal_2_2_5
.type __wcstoull_internal_2_2_5, %function
.symver __wcstoull_internal_2_2_5, __wcstoull_internal@@GLIBC_2.2.5, remove
__wcstoull_internal_2_2_5: .quad 0
.balign 8
.globl regerror_2_2_5
.type regerror_2_2_5, %function
.symver regerror_2_2_5, regerror@@GLIBC_2.2.5, remove
regerror_2_2_5: .quad 0
.balign 8
.globl __isgraph_l_2_2_5
.type __isgraph_l_2_2_5, %function
.symver __isgraph_l_2_2_5, __isgraph_l@@GLIBC_2.2.5, remove
__isgraph_l_2_2_5: .quad 0
.balign 8
.globl catclose_2_2_5
.type catclose_2_2_5, %function
.symver catclose_2_2_5, catclose@@GLIBC_2.2.5, remove
catclose_2_2_5: .quad 0
.balign 8
.globl clock_getres_2_17
.type clock_getres_2_17, %function
.symver clock_getres_2_17, clock_getres@@GLIBC_2.17, remove
clock_getres_2_17: .quad 0
.balign 8
.globl __fgetws_unlocked_chk_2_4
.type __fgetws_unlocked_chk_2_4, %function
.symver __fgetws_unlocked_chk_2_4, __fgetws_unlocked_chk@@GLIBC_2.4, remove
__fgetws_unlocked_chk_2_4: .quad 0
.balign 8
.globl error_2_2_5
.type error_2_2_5, %function
.symver error_2_2_5, error@@GLIBC_2.2.5, remove
error_2_2_5: .quad 0
.balign 8
.globl wcstof_2_2_5
.type wcstof_2_2_5, %function
.symver wcstof_2_2_5, wcstof@@GLIBC_2.2.5, remove
wcstof_2_2_5: .quad 0
.balign 8
.globl wcschrnul_2_2_5
.type wcschrnul_2_2_5, %function
.symver wcschrnul_2_2_5, wcschrnul@@GLIBC_2.2.5, remove
wcschrnul_2_2_5: .quad 0
.balign 8
.globl putwc_2_2_5
.type putwc_2_2_5, %function
.symver putwc_2_2_5, putwc@@GLIBC_2.2.5, remove
putwc_2_2_5: .quad 0
.balign 8
.globl memmove_2_2_5
.type memmove_2_2_5, %function
.symver memmove_2_2_5, memmove@@GLIBC_2.2.5, remove
memmove_2_2_5: .quad 0
.balign 8
.globl strxfrm_2_2_5
.type strxfrm_2_2_5, %function
.symver strxfrm_2_2_5, strxfrm@@GLIBC_2.2.5, remove
strxfrm_2_2_5: .quad 0
.balign 8
.globl __iswlower_l_2_2_5
.type __iswlower_l_2_2_5, %function
.symver __iswlower_l_2_2_5, __iswlower_l@@GLIBC_2.2.5, remove
__iswlower_l_2_2_5: .quad 0
.balign 8
.globl wscanf_2_2_5
.type wscanf_2_2_5, %function
.symver wscanf_2_2_5, wscanf@@GLIBC_2.2.5, remove
wscanf_2_2_5: .quad 0
.balign 8
.globl key_secretkey_is_set_2_2_5
.type key_secretkey_is_set_2_2_5, %function
.symver key_secretkey_is_set_2_2_5, key_secretkey_is_set@@GLIBC_2.2.5, remove
key_secretkey_is_set_2_2_5: .quad 0
.balign 8
.globl pthread_self_2_2_5
.type pthread_self_2_2_5, %function
.symver pthread_self_2_2_5, pthread_self@@GLIBC_2.2.5, remove
pthread_self_2_2_5: .quad 0
.balign 8
.globl parse_printf_format_2_2_5
.type parse_printf_format_2_2_5, %function
.symver parse_printf_format_2_2_5, parse_printf_format@@GLIBC_2.2.5, remove
parse_printf_format_2_2_5: .quad 0
.balign 8
.globl sendfile64_2_3
.type sendfile64_2_3, %function
.symver sendfile64_2_3, sendfile64@@GLIBC_2.3, remove
sendfile64_2_3: .quad 0
.balign 8
.globl posix_madvise_2_2_5
.type posix_madvise_2_2_5, %function
.symver posix_madvise_2_2_5, posix_madvise@@GLIBC_2.2.5, remove
posix_madvise_2_2_5: .quad 0
.balign 8
.globl __strtoll_internal_2_2_5
.type __strtoll_internal_2_2_5, %function
.symver __strtoll_internal_2_2_5, __strtoll_internal@@GLIBC_2.2.5, remove
__strtoll_internal_2_2_5: .quad 0
.balign 8
.globl futimesat_2_4
.type futimesat_2_4, %function
.symver futimesat_2_4, futimesat@@GLIBC_2.4, remove
futimesat_2_4: .quad 0
.balign 8
.globl jrand48_2_2_5
.type jrand48_2_2_5, %function
.symver jrand48_2_2_5, jrand48@@GLIBC_2.2.5, remove
jrand48_2_2_5: .quad 0
.balign 8
.globl pwrite64_2_2_5
.type pwrite64_2_2_5, %function
.symver pwrite64_2_2_5, pwrite64@@GLIBC_2.2.5, remove
pwrite64_2_2_5: .quad 0
.balign 8
.globl __isupper_l_2_2_5
.type __isupper_l_2_2_5, %function
.symver __isupper_l_2_2_5, __isupper_l@@GLIBC_2.2.5, remove
__isupper_l_2_2_5: .quad 0
.balign 8
.globl _IO_file_setbuf_2_2_5
.type _IO_file_setbuf_2_2_5, %function
.symver _IO_file_setbuf_2_2_5, _IO_file_setbuf@@GLIBC_2.2.5, remove
_IO_file_setbuf_2_2_5: .quad 0
.balign 8
.globl gethostbyaddr_2_2_5
.type gethostbyaddr_2_2_5, %function
.symver gethostbyaddr_2_2_5, gethostbyaddr@@GLIBC_2.2.5, remove
gethostbyaddr_2_2_5: .quad 0
.balign 8
.globl nrand48_2_2_5
.type nrand48_2_2_5, %function
.symver nrand48_2_2_5, nrand48@@GLIBC_2.2.5, remove
nrand48_2_2_5: .quad 0
.balign 8
.globl getrpcbyname_r_2_2_5
.type getrpcbyname_r_2_2_5, %function
.symver getrpcbyname_r_2_2_5, getrpcbyname_r@@GLIBC_2.2.5, remove
getrpcbyname_r_2_2_5: .quad 0
.balign 8
.globl tolower_2_2_5
.type tolower_2_2_5, %function
.symver tolower_2_2_5, tolower@@GLIBC_2.2.5, remove
tolower_2_2_5: .quad 0
.balign 8
.globl mount_2_2_5
.type mount_2_2_5, %function
.symver mount_2_2_5, mount@@GLIBC_2.2.5, remove
mount_2_2_5: .quad 0
.balign 8
.globl strcat_2_2_5
.type strcat_2_2_5, %function
.symver strcat_2_2_5, strcat@@GLIBC_2.2.5, remove
strcat_2_2_5: .quad 0
.balign 8
.globl wcpcpy_2_2_5
.type wcpcpy_2_2_5, %function
.symver wcpcpy_2_2_5, wcpcpy@@GLIBC_2.2.5, remove
wcpcpy_2_2_5: .quad 0
.balign 8
.globl argz_create_sep_2_2_5
.type argz_create_sep_2_2_5, %function
.symver argz_create_sep_2_2_5, argz_create_sep@@GLIBC_2.2.5, remove
argz_create_sep_2_2_5: .quad 0
.balign 8
.globl _IO_init_wmarker_2_2_5
.type _IO_init_wmarker_2_2_5, %function
.symver _IO_init_wmarker_2_2_5, _IO_init_wmarker@@GLIBC_2.2.5, remove
_IO_init_wmarker_2_2_5: .quad 0
.balign 8
.globl setipv4sourcefilter_2_3_4
.type setipv4sourcefilter_2_3_4, %function
.symver setipv4sourcefilter_2_3_4, setipv4sourcefilter@@GLIBC_2.3.4, remove
setipv4sourcefilter_2_3_4: .quad 0
.balign 8
.globl ffs_2_2_5
.type ffs_2_2_5, %function
.symver ffs_2_2_5, ffs@@GLIBC_2.2.5, remove
ffs_2_2_5: .quad 0
.balign 8
.globl sync_file_range_2_6
.type sync_file_range_2_6, %function
.symver sync_file_range_2_6, sync_file_range@@GLIBC_2.6, remove
sync_file_range_2_6: .quad 0
.balign 8
.globl strncat_2_2_5
.type strncat_2_2_5, %function
.symver strncat_2_2_5, strncat@@GLIBC_2.2.5, remove
strncat_2_2_5: .quad 0
.balign 8
.globl ether_hostton_2_2_5
.type ether_hostton_2_2_5, %function
.symver ether_hostton_2_2_5, ether_hostton@@GLIBC_2.2.5, remove
ether_hostton_2_2_5: .quad 0
.balign 8
.globl fgetsgent_r_2_10
.type fgetsgent_r_2_10, %function
.symver fgetsgent_r_2_10, fgetsgent_r@@GLIBC_2.10, remove
fgetsgent_r_2_10: .quad 0
.balign 8
.globl getppid_2_2_5
.type getppid_2_2_5, %function
.symver getppid_2_2_5, getppid@@GLIBC_2.2.5, remove
getppid_2_2_5: .quad 0
.balign 8
.globl __assert_2_2_5
.type __assert_2_2_5, %function
.symver __assert_2_2_5, __assert@@GLIBC_2.2.5, remove
__assert_2_2_5: .quad 0
.balign 8
.globl register_printf_function_2_2_5
.type register_printf_function_2_2_5, %function
.symver register_printf_function_2_2_5, register_printf_function@@GLIBC_2.2.5, remove
register_printf_function_2_2_5: .quad 0
.balign 8
.globl fchownat_2_4
.type fchownat_2_4, %function
.symver fchownat_2_4, fchownat@@GLIBC_2.4, remove
fchownat_2_4: .quad 0
.balign 8
.globl fcloseall_2_2_5
.type fcloseall_2_2_5, %function
.symver fcloseall_2_2_5, fcloseall@@GLIBC_2.2.5, remove
fcloseall_2_2_5: .quad 0
.balign 8
.globl vfork_2_2_5
.type vfork_2_2_5, %function
.symver vfork_2_2_5, vfork@@GLIBC_2.2.5, remove
vfork_2_2_5: .quad 0
.balign 8
.globl ecvt_r_2_2_5
.type ecvt_r_2_2_5, %function
.symver ecvt_r_2_2_5, ecvt_r@@GLIBC_2.2.5, remove
ecvt_r_2_2_5: .quad 0
.balign 8
.globl wcsnrtombs_2_2_5
.type wcsnrtombs_2_2_5, %function
.symver wcsnrtombs_2_2_5, wcsnrtombs@@GLIBC_2.2.5, remove
wcsnrtombs_2_2_5: .quad 0
.balign 8
.globl listen_2_2_5
.type listen_2_2_5, %function
.symver listen_2_2_5, listen@@GLIBC_2.2.5, remove
listen_2_2_5: .quad 0
.balign 8
.globl getutmp_2_2_5
.type getutmp_2_2_5, %function
.symver getutmp_2_2_5, getutmp@@GLIBC_2.2.5, remove
getutmp_2_2_5: .quad 0
.balign 8
.globl scalbn_2_2_5
.type scalbn_2_2_5, %function
.symver scalbn_2_2_5, scalbn@@GLIBC_2.2.5, remove
scalbn_2_2_5: .quad 0
.balign 8
.globl ptsname_r_2_2_5
.type ptsname_r_2_2_5, %function
.symver ptsname_r_2_2_5, ptsname_r@@GLIBC_2.2.5, remove
ptsname_r_2_2_5: .quad 0
.balign 8
.globl __strtoll_l_2_2_5
.type __strtoll_l_2_2_5, %function
.symver __strtoll_l_2_2_5, __strtoll_l@@GLIBC_2.2.5, remove
__strtoll_l_2_2_5: .quad 0
.balign 8
.globl sendfile_2_2_5
.type sendfile_2_2_5, %function
.symver sendfile_2_2_5, sendfile@@GLIBC_2.2.5, remove
sendfile_2_2_5: .quad 0
.balign 8
.globl argz_add_2_2_5
.type argz_add_2_2_5, %function
.symver argz_add_2_2_5, argz_add@@GLIBC_2.2.5, remove
argz_add_2_2_5: .quad 0
.balign 8
.globl __libc_realloc_2_2_5
.type __libc_realloc_2_2_5, %function
.symver __libc_realloc_2_2_5, __libc_realloc@@GLIBC_2.2.5, remove
__libc_realloc_2_2_5: .quad 0
.balign 8
.globl verr_2_2_5
.type verr_2_2_5, %function
.symver verr_2_2_5, verr@@GLIBC_2.2.5, remove
verr_2_2_5: .quad 0
.balign 8
.globl gettext_2_2_5
.type gettext_2_2_5, %function
.symver gettext_2_2_5, gettext@@GLIBC_2.2.5, remove
gettext_2_2_5: .quad 0
.balign 8
.globl sched_getaffinity_2_3_3
.type sched_getaffinity_2_3_3, %function
.symver sched_getaffinity_2_3_3, sched_getaffinity@GLIBC_2.3.3, remove
sched_getaffinity_2_3_3: .quad 0
.balign 8
.globl sched_getaffinity_2_3_4
.type sched_getaffinity_2_3_4, %function
.symver sched_getaffinity_2_3_4, sched_getaffinity@@GLIBC_2.3.4, remove
sched_getaffinity_2_3_4: .quad 0
.balign 8
.globl __xpg_basename_2_2_5
.type __xpg_basename_2_2_5, %function
.symver __xpg_basename_2_2_5, __xpg_basename@@GLIBC_2.2.5, remove
__xpg_basename_2_2_5: .quad 0
.balign 8
.globl get_avphys_pages_2_2_5
.type get_avphys_pages_2_2_5, %function
.symver get_avphys_pages_2_2_5, get_avphys_pages@@GLIBC_2.2.5, remove
get_avphys_pages_2_2_5: .quad 0
.balign 8
.globl setbuffer_2_2_5
.type setbuffer_2_2_5, %function
.symver setbuffer_2_2_5, setbuffer@@GLIBC_2.2.5, remove
setbuffer_2_2_5: .quad 0
.balign 8
.globl wcsspn_2_2_5
.type wcsspn_2_2_5, %function
.symver wcsspn_2_2_5, wcsspn@@GLIBC_2.2.5, remove
wcsspn_2_2_5: .quad 0
.balign 8
.globl fork_2_2_5
.type fork_2_2_5, %function
.symver fork_2_2_5, fork@@GLIBC_2.2.5, remove
fork_2_2_5: .quad 0
.balign 8
.globl svc_register_2_2_5
.type svc_register_2_2_5, %function
.symver svc_register_2_2_5, svc_register@@GLIBC_2.2.5, remove
svc_register_2_2_5: .quad 0
.balign 8
.globl readdir64_2_2_5
.type readdir64_2_2_5, %function
.symver readdir64_2_2_5, readdir64@@GLIBC_2.2.5, remove
readdir64_2_2_5: .quad 0
.balign 8
.globl __libc_malloc_2_2_5
.type __libc_malloc_2_2_5, %function
.symver __libc_malloc_2_2_5, __libc_malloc@@GLIBC_2.2.5, remove
__libc_malloc_2_2_5: .quad 0
.balign 8
.globl __lxstat_2_2_5
.type __lxstat_2_2_5, %function
.symver __lxstat_2_2_5, __lxstat@@GLIBC_2.2.5, remove
__lxstat_2_2_5: .quad 0
.balign 8
.globl sched_yield_2_2_5
.type sched_yield_2_2_5, %function
.symver sched_yield_2_2_5, sched_yield@@GLIBC_2.2.5, remove
sched_yield_2_2_5: .quad 0
.balign 8
.globl _IO_str_pbackfail_2_2_5
.type _IO_str_pbackfail_2_2_5, %function
.symver _IO_str_pbackfail_2_2_5, _IO_str_pbackfail@@GLIBC_2.2.5, remove
_IO_str_pbackfail_2_2_5: .quad 0
.balign 8
.globl mkfifoat_2_4
.type mkfifoat_2_4, %function
.symver mkfifoat_2_4, mkfifoat@@GLIBC_2.4, remove
mkfifoat_2_4: .quad 0
.balign 8
.globl wcsncasecmp_l_2_3
.type wcsncasecmp_l_2_3, %function
.symver wcsncasecmp_l_2_3, wcsncasecmp_l@@GLIBC_2.3, remove
wcsncasecmp_l_2_3: .quad 0
.balign 8
.globl duplocale_2_3
.type duplocale_2_3, %function
.symver duplocale_2_3, duplocale@@GLIBC_2.3, remove
duplocale_2_3: .quad 0
.balign 8
.globl eventfd_2_7
.type eventfd_2_7, %function
.symver eventfd_2_7, eventfd@@GLIBC_2.7, remove
eventfd_2_7: .quad 0
.balign 8
.globl getwchar_unlocked_2_2_5
.type getwchar_unlocked_2_2_5, %function
.symver getwchar_unlocked_2_2_5, getwchar_unlocked@@GLIBC_2.2.5, remove
getwchar_unlocked_2_2_5: .quad 0
.balign 8
.globl wcswcs_2_2_5
.type wcswcs_2_2_5, %function
.symver wcswcs_2_2_5, wcswcs@@GLIBC_2.2.5, remove
wcswcs_2_2_5: .quad 0
.balign 8
.globl xdr_short_2_2_5
.type xdr_short_2_2_5, %function
.symver xdr_short_2_2_5, xdr_short@@GLIBC_2.2.5, remove
xdr_short_2_2_5: .quad 0
.balign 8
.globl mktemp_2_2_5
.type mktemp_2_2_5, %function
.symver mktemp_2_2_5, mktemp@@GLIBC_2.2.5, remove
mktemp_2_2_5: .quad 0
.balign 8
.globl strverscmp_2_2_5
.type strverscmp_2_2_5, %function
.symver strverscmp_2_2_5, strverscmp@@GLIBC_2.2.5, remove
strverscmp_2_2_5: .quad 0
.balign 8
.globl wmemmove_2_2_5
.type wmemmove_2_2_5, %function
.symver wmemmove_2_2_5, wmemmove@@GLIBC_2.2.5, remove
wmemmove_2_2_5: .quad 0
.balign 8
.globl ldiv_2_2_5
.type ldiv_2_2_5, %function
.symver ldiv_2_2_5, ldiv@@GLIBC_2.2.5, remove
ldiv_2_2_5: .quad 0
.balign 8
.globl clnt_spcreateerror_2_2_5
.type clnt_spcreateerror_2_2_5, %function
.symver clnt_spcreateerror_2_2_5, clnt_spcreateerror@@GLIBC_2.2.5, remove
clnt_spcreateerror_2_2_5: .quad 0
.balign 8
.globl fgets_2_2_5
.type fgets_2_2_5, %function
.symver fgets_2_2_5, fgets@@GLIBC_2.2.5, remove
fgets_2_2_5: .quad 0
.balign 8
.globl random_r_2_2_5
.type random_r_2_2_5, %function
.symver random_r_2_2_5, random_r@@GLIBC_2.2.5, remove
random_r_2_2_5: .quad 0
.balign 8
.globl isupper_2_2_5
.type isupper_2_2_5, %function
.symver isupper_2_2_5, isupper@@GLIBC_2.2.5, remove
isupper_2_2_5: .quad 0
.balign 8
.globl pthread_attr_setdetachstate_2_2_5
.type pthread_attr_setdetachstate_2_2_5, %function
.symver pthread_attr_setdetachstate_2_2_5, pthread_attr_setdetachstate@@GLIBC_2.2.5, remove
pthread_attr_setdetachstate_2_2_5: .quad 0
.balign 8
.globl sigignore_2_2_5
.type sigignore_2_2_5, %function
.symver sigignore_2_2_5, sigignore@@GLIBC_2.2.5, remove
sigignore_2_2_5: .quad 0
.balign 8
.globl getxattr_2_3
.type getxattr_2_3, %function
.symver getxattr_2_3, getxattr@@GLIBC_2.3, remove
getxattr_2_3: .quad 0
.balign 8
.globl strcmp_2_2_5
.type strcmp_2_2_5, %function
.symver strcmp_2_2_5, strcmp@@GLIBC_2.2.5, remove
strcmp_2_2_5: .quad 0
.balign 8
.globl argp_error_2_2_5
.type argp_error_2_2_5, %function
.symver argp_error_2_2_5, argp_error@@GLIBC_2.2.5, remove
argp_error_2_2_5: .quad 0
.balign 8
.globl _IO_file_attach_2_2_5
.type _IO_file_attach_2_2_5, %function
.symver _IO_file_attach_2_2_5, _IO_file_attach@@GLIBC_2.2.5, remove
_IO_file_attach_2_2_5: .quad 0
.balign 8
.globl sigrelse_2_2_5
.type sigrelse_2_2_5, %function
.symver sigrelse_2_2_5, sigrelse@@GLIBC_2.2.5, remove
sigrelse_2_2_5: .quad 0
.balign 8
.globl ruserpass_2_2_5
.type ruserpass_2_2_5, %function
.symver ruserpass_2_2_5, ruserpass@@GLIBC_2.2.5, remove
ruserpass_2_2_5: .quad 0
.balign 8
.globl mbrtoc16_2_16
.type mbrtoc16_2_16, %function
.symver mbrtoc16_2_16, mbrtoc16@@GLIBC_2.16, remove
mbrtoc16_2_16: .quad 0
.balign 8
.globl wcswidth_2_2_5
.type wcswidth_2_2_5, %function
.symver wcswidth_2_2_5, wcswidth@@GLIBC_2.2.5, remove
wcswidth_2_2_5: .quad 0
.balign 8
.globl opendir_2_2_5
.type opendir_2_2_5, %function
.symver opendir_2_2_5, opendir@@GLIBC_2.2.5, remove
opendir_2_2_5: .quad 0
.balign 8
.globl mallinfo_2_2_5
.type mallinfo_2_2_5, %function
.symver mallinfo_2_2_5, mallinfo@@GLIBC_2.2.5, remove
mallinfo_2_2_5: .quad 0
.balign 8
.globl capset_2_2_5
.type capset_2_2_5, %function
.symver capset_2_2_5, capset@@GLIBC_2.2.5, remove
capset_2_2_5: .quad 0
.balign 8
.globl isprint_2_2_5
.type isprint_2_2_5, %function
.symver isprint_2_2_5, isprint@@GLIBC_2.2.5, remove
isprint_2_2_5: .quad 0
.balign 8
.globl __getpagesize_2_2_5
.type __getpagesize_2_2_5, %function
.symver __getpagesize_2_2_5, __getpagesize@@GLIBC_2.2.5, remove
__getpagesize_2_2_5: .quad 0
.balign 8
.globl wcstoumax_2_2_5
.type wcstoumax_2_2_5, %function
.symver wcstoumax_2_2_5, wcstoumax@@GLIBC_2.2.5, remove
wcstoumax_2_2_5: .quad 0
.balign 8
.globl __fdelt_chk_2_15
.type __fdelt_chk_2_15, %function
.symver __fdelt_chk_2_15, __fdelt_chk@@GLIBC_2.15, remove
__fdelt_chk_2_15: .quad 0
.balign 8
.globl ftruncate64_2_2_5
.type ftruncate64_2_2_5, %function
.symver ftruncate64_2_2_5, ftruncate64@@GLIBC_2.2.5, remove
ftruncate64_2_2_5: .quad 0
.balign 8
.globl iruserok_2_2_5
.type iruserok_2_2_5, %function
.symver iruserok_2_2_5, iruserok@@GLIBC_2.2.5, remove
iruserok_2_2_5: .quad 0
.balign 8
.globl fgetpos_2_2_5
.type fgetpos_2_2_5, %function
.symver fgetpos_2_2_5, fgetpos@@GLIBC_2.2.5, remove
fgetpos_2_2_5: .quad 0
.balign 8
.globl strtoll_2_2_5
.type strtoll_2_2_5, %function
.symver strtoll_2_2_5, strtoll@@GLIBC_2.2.5, remove
strtoll_2_2_5: .quad 0
.balign 8
.globl __vdprintf_chk_2_8
.type __vdprintf_chk_2_8, %function
.symver __vdprintf_chk_2_8, __vdprintf_chk@@GLIBC_2.8, remove
__vdprintf_chk_2_8: .quad 0
.balign 8
.globl xdr_callhdr_2_2_5
.type xdr_callhdr_2_2_5, %function
.symver xdr_callhdr_2_2_5, xdr_callhdr@@GLIBC_2.2.5, remove
xdr_callhdr_2_2_5: .quad 0
.balign 8
.globl _IO_list_resetlock_2_2_5
.type _IO_list_resetlock_2_2_5, %function
.symver _IO_list_resetlock_2_2_5, _IO_list_resetlock@@GLIBC_2.2.5, remove
_IO_list_resetlock_2_2_5: .quad 0
.balign 8
.globl connect_2_2_5
.type connect_2_2_5, %function
.symver connect_2_2_5, connect@@GLIBC_2.2.5, remove
connect_2_2_5: .quad 0
.balign 8
.globl __confstr_chk_2_4
.type __confstr_chk_2_4, %function
.symver __confstr_chk_2_4, __confstr_chk@@GLIBC_2.4, remove
__confstr_chk_2_4: .quad 0
.balign 8
.globl posix_fallocate64_2_2_5
.type posix_fallocate64_2_2_5, %function
.symver posix_fallocate64_2_2_5, posix_fallocate64@@GLIBC_2.2.5, remove
posix_fallocate64_2_2_5: .quad 0
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
.globl setnetent_2_2_5
.type setnetent_2_2_5, %function
.symver setnetent_2_2_5, setnetent@@GLIBC_2.2.5, remove
setnetent_2_2_5: .quad 0
.balign 8
.globl putenv_2_2_5
.type putenv_2_2_5, %function
.symver putenv_2_2_5, putenv@@GLIBC_2.2.5, remove
putenv_2_2_5: .quad 0
.balign 8
.globl strcasecmp_l_2_3
.type strcasecmp_l_2_3, %function
.symver strcasecmp_l_2_3, strcasecmp_l@@GLIBC_2.3, remove
strcasecmp_l_2_3: .quad 0
.balign 8
.globl __ttyname_r_chk_2_4
.type __ttyname_r_chk_2_4, %function
.symver __ttyname_r_chk_2_4, __ttyname_r_chk@@GLIBC_2.4, remove
__ttyname_r_chk_2_4: .quad 0
.balign 8
.globl dirname_2_2_5
.type dirname_2_2_5, %function
.symver dirname_2_2_5, dirname@@GLIBC_2.2.5, remove
dirname_2_2_5: .quad 0
.balign 8
.globl ftello_2_2_5
.type ftello_2_2_5, %function
.symver ftello_2_2_5, ftello@@GLIBC_2.2.5, remove
ftello_2_2_5: .quad 0
.balign 8
.globl tmpfile64_2_2_5
.type tmpfile64_2_2_5, %function
.symver tmpfile64_2_2_5, tmpfile64@@GLIBC_2.2.5, remove
tmpfile64_2_2_5: .quad 0
.balign 8
.globl pthread_setcancelstate_2_2_5
.type pthread_setcancelstate_2_2_5, %function
.symver pthread_setcancelstate_2_2_5, pthread_setcancelstate@@GLIBC_2.2.5, remove
pthread_setcancelstate_2_2_5: .quad 0
.balign 8
.globl argp_failure_2_2_5
.type argp_failure_2_2_5, %function
.symver argp_failure_2_2_5, argp_failure@@GLIBC_2.2.5, remove
argp_failure_2_2_5: .quad 0
.balign 8
.globl strxfrm_l_2_3
.type strxfrm_l_2_3, %function
.symver strxfrm_l_2_3, strxfrm_l@@GLIBC_2.3, remove
strxfrm_l_2_3: .quad 0
.balign 8
.globl strsep_2_2_5
.type strsep_2_2_5, %function
.symver strsep_2_2_5, strsep@@GLIBC_2.2.5, remove
strsep_2_2_5: .quad 0
.balign 8
.globl putchar_unlocked_2_2_5
.type putchar_unlocked_2_2_5, %function
.symver putchar_unlocked_2_2_5, putchar_unlocked@@GLIBC_2.2.5, remove
putchar_unlocked_2_2_5: .quad 0
.balign 8
.globl wcstof_l_2_3
.type wcstof_l_2_3, %function
.symver wcstof_l_2_3, wcstof_l@@GLIBC_2.3, remove
wcstof_l_2_3: .quad 0
.balign 8
.globl removexattr_2_3
.type removexattr_2_3, %function
.symver removexattr_2_3, removexattr@@GLIBC_2.3, remove
removexattr_2_3: .quad 0
.balign 8
.globl gnu_dev_makedev_2_3_3
.type gnu_dev_makedev_2_3_3, %function
.symver gnu_dev_makedev_2_3_3, gnu_dev_makedev@@GLIBC_2.3.3, remove
gnu_dev_makedev_2_3_3: .quad 0
.balign 8
.globl _IO_un_link_2_2_5
.type _IO_un_link_2_2_5, %function
.symver _IO_un_link_2_2_5, _IO_un_link@@GLIBC_2.2.5, remove
_IO_un_link_2_2_5: .quad 0
.balign 8
.globl lockf64_2_2_5
.type lockf64_2_2_5, %function
.symver lockf64_2_2_5, lockf64@@GLIBC_2.2.5, remove
lockf64_2_2_5: .quad 0
.balign 8
.globl _IO_file_fopen_2_2_5
.type _IO_file_fopen_2_2_5, %function
.symver _IO_file_fopen_2_2_5, _IO_file_fopen@@GLIBC_2.2.5, remove
_IO_file_fopen_2_2_5: .quad 0
.balign 8
.globl semctl_2_2_5
.type semctl_2_2_5, %function
.symver semctl_2_2_5, semctl@@GLIBC_2.2.5, remove
semctl_2_2_5: .quad 0
.balign 8
.globl __cxa_finalize_2_2_5
.type __cxa_finalize_2_2_5, %function
.symver __cxa_finalize_2_2_5, __cxa_finalize@@GLIBC_2.2.5, remove
__cxa_finalize_2_2_5: .quad 0
.balign 8
.globl prctl_2_2_5
.type prctl_2_2_5, %function
.symver prctl_2_2_5, prctl@@GLIBC_2.2.5, remove
prctl_2_2_5: .quad 0
.balign 8
.globl readdir_r_2_2_5
.type readdir_r_2_2_5, %function
.symver readdir_r_2_2_5, readdir_r@@GLIBC_2.2.5, remove
readdir_r_2_2_5: .quad 0
.balign 8
.globl drand48_2_2_5
.type drand48_2_2_5, %function
.symver drand48_2_2_5, drand48@@GLIBC_2.2.5, remove
drand48_2_2_5: .quad 0
.balign 8
.globl __wctype_l_2_2_5
.type __wctype_l_2_2_5, %function
.symver __wctype_l_2_2_5, __wctype_l@@GLIBC_2.2.5, remove
__wctype_l_2_2_5: .quad 0
.balign 8
.globl inet6_option_init_2_3_3
.type inet6_option_init_2_3_3, %function
.symver inet6_option_init_2_3_3, inet6_option_init@@GLIBC_2.3.3, remove
inet6_option_init_2_3_3: .quad 0
.balign 8
.globl svcunixfd_create_2_2_5
.type svcunixfd_create_2_2_5, %function
.symver svcunixfd_create_2_2_5, svcunixfd_create@@GLIBC_2.2.5, remove
svcunixfd_create_2_2_5: .quad 0
.balign 8
.globl getsecretkey_2_2_5
.type getsecretkey_2_2_5, %function
.symver getsecretkey_2_2_5, getsecretkey@@GLIBC_2.2.5, remove
getsecretkey_2_2_5: .quad 0
.balign 8
.globl errx_2_2_5
.type errx_2_2_5, %function
.symver errx_2_2_5, errx@@GLIBC_2.2.5, remove
errx_2_2_5: .quad 0
.balign 8
.globl nanosleep_2_2_5
.type nanosleep_2_2_5, %function
.symver nanosleep_2_2_5, nanosleep@@GLIBC_2.2.5, remove
nanosleep_2_2_5: .quad 0
.balign 8
.globl vtimes_2_2_5
.type vtimes_2_2_5, %function
.symver vtimes_2_2_5, vtimes@@GLIBC_2.2.5, remove
vtimes_2_2_5: .quad 0
.balign 8
.globl _IO_file_close_2_2_5
.type _IO_file_close_2_2_5, %function
.symver _IO_file_close_2_2_5, _IO_file_close@@GLIBC_2.2.5, remove
_IO_file_close_2_2_5: .quad 0
.balign 8
.globl xdr_float_2_2_5
.type xdr_float_2_2_5, %function
.symver xdr_float_2_2_5, xdr_float@@GLIBC_2.2.5, remove
xdr_float_2_2_5: .quad 0
.balign 8
.globl _IO_sputbackwc_2_2_5
.type _IO_sputbackwc_2_2_5, %function
.symver _IO_sputbackwc_2_2_5, _IO_sputbackwc@@GLIBC_2.2.5, remove
_IO_sputbackwc_2_2_5: .quad 0
.balign 8
.globl __nss_group_lookup_2_2_5
.type __nss_group_lookup_2_2_5, %function
.symver __nss_group_lookup_2_2_5, __nss_group_lookup@@GLIBC_2.2.5, remove
__nss_group_lookup_2_2_5: .quad 0
.balign 8
.globl __getwd_chk_2_4
.type __getwd_chk_2_4, %function
.symver __getwd_chk_2_4, __getwd_chk@@GLIBC_2.4, remove
__getwd_chk_2_4: .quad 0
.balign 8
.globl _IO_str_init_readonly_2_2_5
.type _IO_str_init_readonly_2_2_5, %function
.symver _IO_str_init_readonly_2_2_5, _IO_str_init_readonly@@GLIBC_2.2.5, remove
_IO_str_init_readonly_2_2_5: .quad 0
.balign 8
.globl wcscoll_2_2_5
.type wcscoll_2_2_5, %function
.symver wcscoll_2_2_5, wcscoll@@GLIBC_2.2.5, remove
wcscoll_2_2_5: .quad 0
.balign 8
.globl lrand48_r_2_2_5
.type lrand48_r_2_2_5, %function
.symver lrand48_r_2_2_5, lrand48_r@@GLIBC_2.2.5, remove
lrand48_r_2_2_5: .quad 0
.balign 8
.globl __vsyslog_chk_2_4
.type __vsyslog_chk_2_4, %function
.symver __vsyslog_chk_2_4, __vsyslog_chk@@GLIBC_2.4, remove
__vsyslog_chk_2_4: .quad 0
.balign 8
.globl svcerr_weakauth_2_2_5
.type svcerr_weakauth_2_2_5, %function
.symver svcerr_weakauth_2_2_5, svcerr_weakauth@@GLIBC_2.2.5, remove
svcerr_weakauth_2_2_5: .quad 0
.balign 8
.globl setservent_2_2_5
.type setservent_2_2_5, %function
.symver setservent_2_2_5, setservent@@GLIBC_2.2.5, remove
setservent_2_2_5: .quad 0
.balign 8
.globl bzero_2_2_5
.type bzero_2_2_5, %function
.symver bzero_2_2_5, bzero@@GLIBC_2.2.5, remove
bzero_2_2_5: .quad 0
.balign 8
.globl __freadable_2_2_5
.type __freadable_2_2_5, %function
.symver __freadable_2_2_5, __freadable@@GLIBC_2.2.5, remove
__freadable_2_2_5: .quad 0
.balign 8
.globl getmsg_2_2_5
.type getmsg_2_2_5, %function
.symver getmsg_2_2_5, getmsg@@GLIBC_2.2.5, remove
getmsg_2_2_5: .quad 0
.balign 8
.globl flistxattr_2_3
.type flistxattr_2_3, %function
.symver flistxattr_2_3, flistxattr@@GLIBC_2.3, remove
flistxattr_2_3: .quad 0
.balign 8
.globl _IO_gets_2_2_5
.type _IO_gets_2_2_5, %function
.symver _IO_gets_2_2_5, _IO_gets@@GLIBC_2.2.5, remove
_IO_gets_2_2_5: .quad 0
.balign 8
.globl wprintf_2_2_5
.type wprintf_2_2_5, %function
.symver wprintf_2_2_5, wprintf@@GLIBC_2.2.5, remove
wprintf_2_2_5: .quad 0
.balign 8
.globl re_search_2_2_5
.type re_search_2_2_5, %function
.symver re_search_2_2_5, re_search@@GLIBC_2.2.5, remove
re_search_2_2_5: .quad 0
.balign 8
.globl statvfs64_2_2_5
.type statvfs64_2_2_5, %function
.symver statvfs64_2_2_5, statvfs64@@GLIBC_2.2.5, remove
statvfs64_2_2_5: .quad 0
.balign 8
.globl register_printf_type_2_10
.type register_printf_type_2_10, %function
.symver register_printf_type_2_10, register_printf_type@@GLIBC_2.10, remove
register_printf_type_2_10: .quad 0
.balign 8
.globl pthread_attr_setschedparam_2_2_5
.type pthread_attr_setschedparam_2_2_5, %function
.symver pthread_attr_setschedparam_2_2_5, pthread_attr_setschedparam@@GLIBC_2.2.5, remove
pthread_attr_setschedparam_2_2_5: .quad 0
.balign 8
.globl sigqueue_2_2_5
.type sigqueue_2_2_5, %function
.symver sigqueue_2_2_5, sigqueue@@GLIBC_2.2.5, remove
sigqueue_2_2_5: .quad 0
.balign 8
.globl __sched_getscheduler_2_2_5
.type __sched_getscheduler_2_2_5, %function
.symver __sched_getscheduler_2_2_5, __sched_getscheduler@@GLIBC_2.2.5, remove
__sched_getscheduler_2_2_5: .quad 0
.balign 8
.globl _IO_file_finish_2_2_5
.type _IO_file_finish_2_2_5, %function
.symver _IO_file_finish_2_2_5, _IO_file_finish@@GLIBC_2.2.5, remove
_IO_file_finish_2_2_5: .quad 0
.balign 8
.globl clntraw_create_2_2_5
.type clntraw_create_2_2_5, %function
.symver clntraw_create_2_2_5, clntraw_create@@GLIBC_2.2.5, remove
clntraw_create_2_2_5: .quad 0
.balign 8
.globl initstate_r_2_2_5
.type initstate_r_2_2_5, %function
.symver initstate_r_2_2_5, initstate_r@@GLIBC_2.2.5, remove
initstate_r_2_2_5: .quad 0
.balign 8
.globl __strsep_g_2_2_5
.type __strsep_g_2_2_5, %function
.symver __strsep_g_2_2_5, __strsep_g@@GLIBC_2.2.5, remove
__strsep_g_2_2_5: .quad 0
.balign 8
.globl xdecrypt_2_2_5
.type xdecrypt_2_2_5, %function
.symver xdecrypt_2_2_5, xdecrypt@@GLIBC_2.2.5, remove
xdecrypt_2_2_5: .quad 0
.balign 8
.globl _IO_setvbuf_2_2_5
.type _IO_setvbuf_2_2_5, %function
.symver _IO_setvbuf_2_2_5, _IO_setvbuf@@GLIBC_2.2.5, remove
_IO_setvbuf_2_2_5: .quad 0
.balign 8
.globl setmntent_2_2_5
.type setmntent_2_2_5, %function
.symver setmntent_2_2_5, setmntent@@GLIBC_2.2.5, remove
setmntent_2_2_5: .quad 0
.balign 8
.globl islower_2_2_5
.type islower_2_2_5, %function
.symver islower_2_2_5, islower@@GLIBC_2.2.5, remove
islower_2_2_5: .quad 0
.balign 8
.globl dprintf_2_2_5
.type dprintf_2_2_5, %function
.symver dprintf_2_2_5, dprintf@@GLIBC_2.2.5, remove
dprintf_2_2_5: .quad 0
.balign 8
.globl _obstack_allocated_p_2_2_5
.type _obstack_allocated_p_2_2_5, %function
.symver _obstack_allocated_p_2_2_5, _obstack_allocated_p@@GLIBC_2.2.5, remove
_obstack_allocated_p_2_2_5: .quad 0
.balign 8
.globl _obstack_begin_1_2_2_5
.type _obstack_begin_1_2_2_5, %function
.symver _obstack_begin_1_2_2_5, _obstack_begin_1@@GLIBC_2.2.5, remove
_obstack_begin_1_2_2_5: .quad 0
.balign 8
.globl envz_add_2_2_5
.type envz_add_2_2_5, %function
.symver envz_add_2_2_5, envz_add@@GLIBC_2.2.5, remove
envz_add_2_2_5: .quad 0
.balign 8
.globl versionsort_2_2_5
.type versionsort_2_2_5, %function
.symver versionsort_2_2_5, versionsort@@GLIBC_2.2.5, remove
versionsort_2_2_5: .quad 0
.balign 8
.globl tcsetattr_2_2_5
.type tcsetattr_2_2_5, %function
.symver tcsetattr_2_2_5, tcsetattr@@GLIBC_2.2.5, remove
tcsetattr_2_2_5: .quad 0
.balign 8
.globl strerror_2_2_5
.type strerror_2_2_5, %function
.symver strerror_2_2_5, strerror@@GLIBC_2.2.5, remove
strerror_2_2_5: .quad 0
.balign 8
.globl __xstat_2_2_5
.type __xstat_2_2_5, %function
.symver __xstat_2_2_5, __xstat@@GLIBC_2.2.5, remove
__xstat_2_2_5: .quad 0
.balign 8
.globl endaliasent_2_2_5
.type endaliasent_2_2_5, %function
.symver endaliasent_2_2_5, endaliasent@@GLIBC_2.2.5, remove
endaliasent_2_2_5: .quad 0
.balign 8
.globl ctime_2_2_5
.type ctime_2_2_5, %function
.symver ctime_2_2_5, ctime@@GLIBC_2.2.5, remove
ctime_2_2_5: .quad 0
.balign 8
.globl tcsendbreak_2_2_5
.type tcsendbreak_2_2_5, %function
.symver tcsendbreak_2_2_5, tcsendbreak@@GLIBC_2.2.5, remove
tcsendbreak_2_2_5: .quad 0
.balign 8
.globl _IO_fgetpos_2_2_5
.type _IO_fgetpos_2_2_5, %function
.symver _IO_fgetpos_2_2_5, _IO_fgetpos@@GLIBC_2.2.5, remove
_IO_fgetpos_2_2_5: .quad 0
.balign 8
.globl rawmemchr_2_2_5
.type rawmemchr_2_2_5, %function
.symver rawmemchr_2_2_5, rawmemchr@@GLIBC_2.2.5, remove
rawmemchr_2_2_5: .quad 0
.balign 8
.globl statfs_2_2_5
.type statfs_2_2_5, %function
.symver statfs_2_2_5, statfs@@GLIBC_2.2.5, remove
statfs_2_2_5: .quad 0
.balign 8
.globl __strcasecmp_l_2_2_5
.type __strcasecmp_l_2_2_5, %function
.symver __strcasecmp_l_2_2_5, __strcasecmp_l@@GLIBC_2.2.5, remove
__strcasecmp_l_2_2_5: .quad 0
.balign 8
.globl posix_spawn_file_actions_addopen_2_2_5
.type posix_spawn_file_actions_addopen_2_2_5, %function
.symver posix_spawn_file_actions_addopen_2_2_5, posix_spawn_file_actions_addopen@@GLIBC_2.2.5, remove
posix_spawn_file_actions_addopen_2_2_5: .quad 0
.balign 8
.globl __isinff_2_2_5
.type __isinff_2_2_5, %function
.symver __isinff_2_2_5, __isinff@@GLIBC_2.2.5, remove
__isinff_2_2_5: .quad 0
.balign 8
.globl inotify_init_2_4
.type inotify_init_2_4, %function
.symver inotify_init_2_4, inotify_init@@GLIBC_2.4, remove
inotify_init_2_4: .quad 0
.balign 8
.globl strtouq_2_2_5
.type strtouq_2_2_5, %function
.symver strtouq_2_2_5, strtouq@@GLIBC_2.2.5, remove
strtouq_2_2_5: .quad 0
.balign 8
.globl isxdigit_2_2_5
.type isxdigit_2_2_5, %function
.symver isxdigit_2_2_5, isxdigit@@GLIBC_2.2.5, remove
isxdigit_2_2_5: .quad 0
.balign 8
.globl setutxent_2_2_5
.type setutxent_2_2_5, %function
.symver setutxent_2_2_5, setutxent@@GLIBC_2.2.5, remove
setutxent_2_2_5: .quad 0
.balign 8
.globl wctype_2_2_5
.type wctype_2_2_5, %function
.symver wctype_2_2_5, wctype@@GLIBC_2.2.5, remove
wctype_2_2_5: .quad 0
.balign 8
.globl getspent_2_2_5
.type getspent_2_2_5, %function
.symver getspent_2_2_5, getspent@@GLIBC_2.2.5, remove
getspent_2_2_5: .quad 0
.balign 8
.globl __strtod_l_2_2_5
.type __strtod_l_2_2_5, %function
.symver __strtod_l_2_2_5, __strtod_l@@GLIBC_2.2.5, remove
__strtod_l_2_2_5: .quad 0
.balign 8
.globl __sigsetjmp_2_2_5
.type __sigsetjmp_2_2_5, %function
.symver __sigsetjmp_2_2_5, __sigsetjmp@@GLIBC_2.2.5, remove
__sigsetjmp_2_2_5: .quad 0
.balign 8
.globl posix_spawn_file_actions_adddup2_2_2_5
.type posix_spawn_file_actions_adddup2_2_2_5, %function
.symver posix_spawn_file_actions_adddup2_2_2_5, posix_spawn_file_actions_adddup2@@GLIBC_2.2.5, remove
posix_spawn_file_actions_adddup2_2_2_5: .quad 0
.balign 8
.globl towctrans_2_2_5
.type towctrans_2_2_5, %function
.symver towctrans_2_2_5, towctrans@@GLIBC_2.2.5, remove
towctrans_2_2_5: .quad 0
.balign 8
.globl execlp_2_2_5
.type execlp_2_2_5, %function
.symver execlp_2_2_5, execlp@@GLIBC_2.2.5, remove
execlp_2_2_5: .quad 0
.balign 8
.globl __wmempcpy_chk_2_4
.type __wmempcpy_chk_2_4, %function
.symver __wmempcpy_chk_2_4, __wmempcpy_chk@@GLIBC_2.4, remove
__wmempcpy_chk_2_4: .quad 0
.balign 8
.globl isalnum_l_2_3
.type isalnum_l_2_3, %function
.symver isalnum_l_2_3, isalnum_l@@GLIBC_2.3, remove
isalnum_l_2_3: .quad 0
.balign 8
.globl get_phys_pages_2_2_5
.type get_phys_pages_2_2_5, %function
.symver get_phys_pages_2_2_5, get_phys_pages@@GLIBC_2.2.5, remove
get_phys_pages_2_2_5: .quad 0
.balign 8
.globl shmget_2_2_5
.type shmget_2_2_5, %function
.symver shmget_2_2_5, shmget@@GLIBC_2.2.5, remove
shmget_2_2_5: .quad 0
.balign 8
.globl malloc_set_state_2_2_5
.type malloc_set_state_2_2_5, %function
.symver malloc_set_state_2_2_5, malloc_set_state@@GLIBC_2.2.5, remove
malloc_set_state_2_2_5: .quad 0
.balign 8
.globl pthread_attr_setschedpolicy_2_2_5
.type pthread_attr_setschedpolicy_2_2_5, %function
.symver pthread_attr_setschedpolicy_2_2_5, pthread_attr_setschedpolicy@@GLIBC_2.2.5, remove
pthread_attr_setschedpolicy_2_2_5: .quad 0
.balign 8
.globl ungetwc_2_2_5
.type ungetwc_2_2_5, %function
.symver ungetwc_2_2_5, ungetwc@@GLIBC_2.2.5, remove
ungetwc_2_2_5: .quad 0
.balign 8
.globl __fwriting_2_2_5
.type __fwriting_2_2_5, %function
.symver __fwriting_2_2_5, __fwriting@@GLIBC_2.2.5, remove
__fwriting_2_2_5: .quad 0
.balign 8
.globl __sigismember_2_2_5
.type __sigismember_2_2_5, %function
.symver __sigismember_2_2_5, __sigismember@@GLIBC_2.2.5, remove
__sigismember_2_2_5: .quad 0
.balign 8
.globl getresuid_2_2_5
.type getresuid_2_2_5, %function
.symver getresuid_2_2_5, getresuid@@GLIBC_2.2.5, remove
getresuid_2_2_5: .quad 0
.balign 8
.globl abort_2_2_5
.type abort_2_2_5, %function
.symver abort_2_2_5, abort@@GLIBC_2.2.5, remove
abort_2_2_5: .quad 0
.balign 8
.globl __getmntent_r_2_2_5
.type __getmntent_r_2_2_5, %function
.symver __getmntent_r_2_2_5, __getmntent_r@@GLIBC_2.2.5, remove
__getmntent_r_2_2_5: .quad 0
.balign 8
.globl strncmp_2_2_5
.type strncmp_2_2_5, %function
.symver strncmp_2_2_5, strncmp@@GLIBC_2.2.5, remove
strncmp_2_2_5: .quad 0
.balign 8
.globl wordexp_2_2_5
.type wordexp_2_2_5, %function
.symver wordexp_2_2_5, wordexp@@GLIBC_2.2.5, remove
wordexp_2_2_5: .quad 0
.balign 8
.globl sigemptyset_2_2_5
.type sigemptyset_2_2_5, %function
.symver sigemptyset_2_2_5, sigemptyset@@GLIBC_2.2.5, remove
sigemptyset_2_2_5: .quad 0
.balign 8
.globl fchflags_2_2_5
.type fchflags_2_2_5, %function
.symver fchflags_2_2_5, fchflags@@GLIBC_2.2.5, remove
fchflags_2_2_5: .quad 0
.balign 8
.globl svcunix_create_2_2_5
.type svcunix_create_2_2_5, %function
.symver svcunix_create_2_2_5, svcunix_create@@GLIBC_2.2.5, remove
svcunix_create_2_2_5: .quad 0
.balign 8
.globl creat_2_2_5
.type creat_2_2_5, %function
.symver creat_2_2_5, creat@@GLIBC_2.2.5, remove
creat_2_2_5: .quad 0
.balign 8
.globl wait3_2_2_5
.type wait3_2_2_5, %function
.symver wait3_2_2_5, wait3@@GLIBC_2.2.5, remove
wait3_2_2_5: .quad 0
.balign 8
.globl _IO_switch_to_wbackup_area_2_2_5
.type _IO_switch_to_wbackup_area_2_2_5, %function
.symver _IO_switch_to_wbackup_area_2_2_5, _IO_switch_to_wbackup_area@@GLIBC_2.2.5, remove
_IO_switch_to_wbackup_area_2_2_5: .quad 0
.balign 8
.globl wait4_2_2_5
.type wait4_2_2_5, %function
.symver wait4_2_2_5, wait4@@GLIBC_2.2.5, remove
wait4_2_2_5: .quad 0
.balign 8
.globl if_nametoindex_2_2_5
.type if_nametoindex_2_2_5, %function
.symver if_nametoindex_2_2_5, if_nametoindex@@GLIBC_2.2.5, remove
if_nametoindex_2_2_5: .quad 0
.balign 8
.globl getenv_2_2_5
.type getenv_2_2_5, %function
.symver getenv_2_2_5, getenv@@GLIBC_2.2.5, remove
getenv_2_2_5: .quad 0
.balign 8
.globl mktime_2_2_5
.type mktime_2_2_5, %function
.symver mktime_2_2_5, mktime@@GLIBC_2.2.5, remove
mktime_2_2_5: .quad 0
.balign 8
.globl malloc_trim_2_2_5
.type malloc_trim_2_2_5, %function
.symver malloc_trim_2_2_5, malloc_trim@@GLIBC_2.2.5, remove
malloc_trim_2_2_5: .quad 0
.balign 8
.globl setrpcent_2_2_5
.type setrpcent_2_2_5, %function
.symver setrpcent_2_2_5, setrpcent@@GLIBC_2.2.5, remove
setrpcent_2_2_5: .quad 0
.balign 8
.globl _IO_free_backup_area_2_2_5
.type _IO_free_backup_area_2_2_5, %function
.symver _IO_free_backup_area_2_2_5, _IO_free_backup_area@@GLIBC_2.2.5, remove
_IO_free_backup_area_2_2_5: .quad 0
.balign 8
.globl __stack_chk_fail_2_4
.type __stack_chk_fail_2_4, %function
.symver __stack_chk_fail_2_4, __stack_chk_fail@@GLIBC_2.4, remove
__stack_chk_fail_2_4: .quad 0
.balign 8
.globl getnameinfo_2_2_5
.type getnameinfo_2_2_5, %function
.symver getnameinfo_2_2_5, getnameinfo@@GLIBC_2.2.5, remove
getnameinfo_2_2_5: .quad 0
.balign 8
.globl vswscanf_2_2_5
.type vswscanf_2_2_5, %function
.symver vswscanf_2_2_5, vswscanf@@GLIBC_2.2.5, remove
vswscanf_2_2_5: .quad 0
.balign 8
.globl getsgent_2_10
.type getsgent_2_10, %function
.symver getsgent_2_10, getsgent@@GLIBC_2.10, remove
getsgent_2_10: .quad 0
.balign 8
.globl pwrite_2_2_5
.type pwrite_2_2_5, %function
.symver pwrite_2_2_5, pwrite@@GLIBC_2.2.5, remove
pwrite_2_2_5: .quad 0
.balign 8
.globl wcsstr_2_2_5
.type wcsstr_2_2_5, %function
.symver wcsstr_2_2_5, wcsstr@@GLIBC_2.2.5, remove
wcsstr_2_2_5: .quad 0
.balign 8
.globl getrlimit64_2_2_5
.type getrlimit64_2_2_5, %function
.symver getrlimit64_2_2_5, getrlimit64@@GLIBC_2.2.5, remove
getrlimit64_2_2_5: .quad 0
.balign 8
.globl setresgid_2_2_5
.type setresgid_2_2_5, %function
.symver setresgid_2_2_5, setresgid@@GLIBC_2.2.5, remove
setresgid_2_2_5: .quad 0
.balign 8
.globl __nss_configure_lookup_2_2_5
.type __nss_configure_lookup_2_2_5, %function
.symver __nss_configure_lookup_2_2_5, __nss_configure_lookup@@GLIBC_2.2.5, remove
__nss_configure_lookup_2_2_5: .quad 0
.balign 8
.globl xdr_uint32_t_2_2_5
.type xdr_uint32_t_2_2_5, %function
.symver xdr_uint32_t_2_2_5, xdr_uint32_t@@GLIBC_2.2.5, remove
xdr_uint32_t_2_2_5: .quad 0
.balign 8
.globl closedir_2_2_5
.type closedir_2_2_5, %function
.symver closedir_2_2_5, closedir@@GLIBC_2.2.5, remove
closedir_2_2_5: .quad 0
.balign 8
.globl munlock_2_2_5
.type munlock_2_2_5, %function
.symver munlock_2_2_5, munlock@@GLIBC_2.2.5, remove
munlock_2_2_5: .quad 0
.balign 8
.globl isupper_l_2_3
.type isupper_l_2_3, %function
.symver isupper_l_2_3, isupper_l@@GLIBC_2.3, remove
isupper_l_2_3: .quad 0
.balign 8
.globl addmntent_2_2_5
.type addmntent_2_2_5, %function
.symver addmntent_2_2_5, addmntent@@GLIBC_2.2.5, remove
addmntent_2_2_5: .quad 0
.balign 8
.globl getgrouplist_2_2_5
.type getgrouplist_2_2_5, %function
.symver getgrouplist_2_2_5, getgrouplist@@GLIBC_2.2.5, remove
getgrouplist_2_2_5: .quad 0
.balign 8
.globl _IO_file_write_2_2_5
.type _IO_file_write_2_2_5, %function
.symver _IO_file_write_2_2_5, _IO_file_write@@GLIBC_2.2.5, remove
_IO_file_write_2_2_5: .quad 0
.balign 8
.globl __wcstoul_internal_2_2_5
.type __wcstoul_internal_2_2_5, %function
.symver __wcstoul_internal_2_2_5, __wcstoul_internal@@GLIBC_2.2.5, remove
__wcstoul_internal_2_2_5: .quad 0
.balign 8
.globl mlockall_2_2_5
.type mlockall_2_2_5, %function
.symver mlockall_2_2_5, mlockall@@GLIBC_2.2.5, remove
mlockall_2_2_5: .quad 0
.balign 8
.globl pthread_getschedparam_2_2_5
.type pthread_getschedparam_2_2_5, %function
.symver pthread_getschedparam_2_2_5, pthread_getschedparam@@GLIBC_2.2.5, remove
pthread_getschedparam_2_2_5: .quad 0
.balign 8
.globl pread64_2_2_5
.type pread64_2_2_5, %function
.symver pread64_2_2_5, pread64@@GLIBC_2.2.5, remove
pread64_2_2_5: .quad 0
.balign 8
.globl wcstombs_2_2_5
.type wcstombs_2_2_5, %function
.symver wcstombs_2_2_5, wcstombs@@GLIBC_2.2.5, remove
wcstombs_2_2_5: .quad 0
.balign 8
.globl __default_morecore_2_2_5
.type __default_morecore_2_2_5, %function
.symver __default_morecore_2_2_5, __default_morecore@@GLIBC_2.2.5, remove
__default_morecore_2_2_5: .quad 0
.balign 8
.globl mremap_2_2_5
.type mremap_2_2_5, %function
.symver mremap_2_2_5, mremap@@GLIBC_2.2.5, remove
mremap_2_2_5: .quad 0
.balign 8
.globl setlogmask_2_2_5
.type setlogmask_2_2_5, %function
.symver setlogmask_2_2_5, setlogmask@@GLIBC_2.2.5, remove
setlogmask_2_2_5: .quad 0
.balign 8
.globl putchar_2_2_5
.type putchar_2_2_5, %function
.symver putchar_2_2_5, putchar@@GLIBC_2.2.5, remove
putchar_2_2_5: .quad 0
.balign 8
.globl _IO_file_sync_2_2_5
.type _IO_file_sync_2_2_5, %function
.symver _IO_file_sync_2_2_5, _IO_file_sync@@GLIBC_2.2.5, remove
_IO_file_sync_2_2_5: .quad 0
.balign 8
.globl open_by_handle_at_2_14
.type open_by_handle_at_2_14, %function
.symver open_by_handle_at_2_14, open_by_handle_at@@GLIBC_2.14, remove
open_by_handle_at_2_14: .quad 0
.balign 8
.globl openat_2_4
.type openat_2_4, %function
.symver openat_2_4, openat@@GLIBC_2.4, remove
openat_2_4: .quad 0
.balign 8
.globl fsetpos64_2_2_5
.type fsetpos64_2_2_5, %function
.symver fsetpos64_2_2_5, fsetpos64@@GLIBC_2.2.5, remove
fsetpos64_2_2_5: .quad 0
.balign 8
.globl sigpause_2_2_5
.type sigpause_2_2_5, %function
.symver sigpause_2_2_5, sigpause@@GLIBC_2.2.5, remove
sigpause_2_2_5: .quad 0
.balign 8
.globl _IO_ftrylockfile_2_2_5
.type _IO_ftrylockfile_2_2_5, %function
.symver _IO_ftrylockfile_2_2_5, _IO_ftrylockfile@@GLIBC_2.2.5, remove
_IO_ftrylockfile_2_2_5: .quad 0
.balign 8
.globl xdr_u_longlong_t_2_2_5
.type xdr_u_longlong_t_2_2_5, %function
.symver xdr_u_longlong_t_2_2_5, xdr_u_longlong_t@@GLIBC_2.2.5, remove
xdr_u_longlong_t_2_2_5: .quad 0
.balign 8
.globl xdr_netnamestr_2_2_5
.type xdr_netnamestr_2_2_5, %function
.symver xdr_netnamestr_2_2_5, xdr_netnamestr@@GLIBC_2.2.5, remove
xdr_netnamestr_2_2_5: .quad 0
.balign 8
.globl getdirentries_2_2_5
.type getdirentries_2_2_5, %function
.symver getdirentries_2_2_5, getdirentries@@GLIBC_2.2.5, remove
getdirentries_2_2_5: .quad 0
.balign 8
.globl ldexpf_2_2_5
.type ldexpf_2_2_5, %function
.symver ldexpf_2_2_5, ldexpf@@GLIBC_2.2.5, remove
ldexpf_2_2_5: .quad 0
.balign 8
.globl fprintf_2_2_5
.type fprintf_2_2_5, %function
.symver fprintf_2_2_5, fprintf@@GLIBC_2.2.5, remove
fprintf_2_2_5: .quad 0
.balign 8
.globl __iswprint_l_2_2_5
.type __iswprint_l_2_2_5, %function
.symver __iswprint_l_2_2_5, __iswprint_l@@GLIBC_2.2.5, remove
__iswprint_l_2_2_5: .quad 0
.balign 8
.globl uselib_2_2_5
.type uselib_2_2_5, %function
.symver uselib_2_2_5, uselib@@GLIBC_2.2.5, remove
uselib_2_2_5: .quad 0
.balign 8
.globl endttyent_2_2_5
.type endttyent_2_2_5, %function
.symver endttyent_2_2_5, endttyent@@GLIBC_2.2.5, remove
endttyent_2_2_5: .quad 0
.balign 8
.globl memfrob_2_2_5
.type memfrob_2_2_5, %function
.symver memfrob_2_2_5, memfrob@@GLIBC_2.2.5, remove
memfrob_2_2_5: .quad 0
.balign 8
.globl xdr_int16_t_2_2_5
.type xdr_int16_t_2_2_5, %function
.symver xdr_int16_t_2_2_5, xdr_int16_t@@GLIBC_2.2.5, remove
xdr_int16_t_2_2_5: .quad 0
.balign 8
.globl remque_2_2_5
.type remque_2_2_5, %function
.symver remque_2_2_5, remque@@GLIBC_2.2.5, remove
remque_2_2_5: .quad 0
.balign 8
.globl get_current_dir_name_2_2_5
.type get_current_dir_name_2_2_5, %function
.symver get_current_dir_name_2_2_5, get_current_dir_name@@GLIBC_2.2.5, remove
get_current_dir_name_2_2_5: .quad 0
.balign 8
.globl __ivaliduser_2_2_5
.type __ivaliduser_2_2_5, %function
.symver __ivaliduser_2_2_5, __ivaliduser@@GLIBC_2.2.5, remove
__ivaliduser_2_2_5: .quad 0
.balign 8
.globl __nss_hosts_lookup_2_2_5
.type __nss_hosts_lookup_2_2_5, %function
.symver __nss_hosts_lookup_2_2_5, __nss_hosts_lookup@@GLIBC_2.2.5, remove
__nss_hosts_lookup_2_2_5: .quad 0
.balign 8
.globl xdr_int64_t_2_2_5
.type xdr_int64_t_2_2_5, %function
.symver xdr_int64_t_2_2_5, xdr_int64_t@@GLIBC_2.2.5, remove
xdr_int64_t_2_2_5: .quad 0
.balign 8
.globl bindresvport_2_2_5
.type bindresvport_2_2_5, %function
.symver bindresvport_2_2_5, bindresvport@@GLIBC_2.2.5, remove
bindresvport_2_2_5: .quad 0
.balign 8
.globl xdr_int_2_2_5
.type xdr_int_2_2_5, %function
.symver xdr_int_2_2_5, xdr_int@@GLIBC_2.2.5, remove
xdr_int_2_2_5: .quad 0
.balign 8
.globl mkstemp64_2_2_5
.type mkstemp64_2_2_5, %function
.symver mkstemp64_2_2_5, mkstemp64@@GLIBC_2.2.5, remove
mkstemp64_2_2_5: .quad 0
.balign 8
.globl ftime_2_2_5
.type ftime_2_2_5, %function
.symver ftime_2_2_5, ftime@@GLIBC_2.2.5, remove
ftime_2_2_5: .quad 0
.balign 8
.globl quotactl_2_2_5
.type quotactl_2_2_5, %function
.symver quotactl_2_2_5, quotactl@@GLIBC_2.2.5, remove
quotactl_2_2_5: .quad 0
.balign 8
.globl isblank_2_2_5
.type isblank_2_2_5, %function
.symver isblank_2_2_5, isblank@@GLIBC_2.2.5, remove
isblank_2_2_5: .quad 0
.balign 8
.globl hsearch_2_2_5
.type hsearch_2_2_5, %function
.symver hsearch_2_2_5, hsearch@@GLIBC_2.2.5, remove
hsearch_2_2_5: .quad 0
.balign 8
.globl strchrnul_2_2_5
.type strchrnul_2_2_5, %function
.symver strchrnul_2_2_5, strchrnul@@GLIBC_2.2.5, remove
strchrnul_2_2_5: .quad 0
.balign 8
.globl unsetenv_2_2_5
.type unsetenv_2_2_5, %function
.symver unsetenv_2_2_5, unsetenv@@GLIBC_2.2.5, remove
unsetenv_2_2_5: .quad 0
.balign 8
.globl fclose_2_2_5
.type fclose_2_2_5, %function
.symver fclose_2_2_5, fclose@@GLIBC_2.2.5, remove
fclose_2_2_5: .quad 0
.balign 8
.globl __underflow_2_2_5
.type __underflow_2_2_5, %function
.symver __underflow_2_2_5, __underflow@@GLIBC_2.2.5, remove
__underflow_2_2_5: .quad 0
.balign 8
.globl ioperm_2_2_5
.type ioperm_2_2_5, %function
.symver ioperm_2_2_5, ioperm@@GLIBC_2.2.5, remove
ioperm_2_2_5: .quad 0
.balign 8
.globl get_nprocs_conf_2_2_5
.type get_nprocs_conf_2_2_5, %function
.symver get_nprocs_conf_2_2_5, get_nprocs_conf@@GLIBC_2.2.5, remove
get_nprocs_conf_2_2_5: .quad 0
.balign 8
.globl error_at_line_2_2_5
.type error_at_line_2_2_5, %function
.symver error_at_line_2_2_5, error_at_line@@GLIBC_2.2.5, remove
error_at_line_2_2_5: .quad 0
.balign 8
.globl newlocale_2_3
.type newlocale_2_3, %function
.symver newlocale_2_3, newlocale@@GLIBC_2.3, remove
newlocale_2_3: .quad 0
.balign 8
.globl stime_2_2_5
.type stime_2_2_5, %function
.symver stime_2_2_5, stime@@GLIBC_2.2.5, remove
stime_2_2_5: .quad 0
.balign 8
.globl xdr_authdes_verf_2_2_5
.type xdr_authdes_verf_2_2_5, %function
.symver xdr_authdes_verf_2_2_5, xdr_authdes_verf@@GLIBC_2.2.5, remove
xdr_authdes_verf_2_2_5: .quad 0
.balign 8
.globl getfsent_2_2_5
.type getfsent_2_2_5, %function
.symver getfsent_2_2_5, getfsent@@GLIBC_2.2.5, remove
getfsent_2_2_5: .quad 0
.balign 8
.globl select_2_2_5
.type select_2_2_5, %function
.symver select_2_2_5, select@@GLIBC_2.2.5, remove
select_2_2_5: .quad 0
.balign 8
.globl sigset_2_2_5
.type sigset_2_2_5, %function
.symver sigset_2_2_5, sigset@@GLIBC_2.2.5, remove
sigset_2_2_5: .quad 0
.balign 8
.globl _IO_wfile_sync_2_2_5
.type _IO_wfile_sync_2_2_5, %function
.symver _IO_wfile_sync_2_2_5, _IO_wfile_sync@@GLIBC_2.2.5, remove
_IO_wfile_sync_2_2_5: .quad 0
.balign 8
.globl nftw64_2_2_5
.type nftw64_2_2_5, %function
.symver nftw64_2_2_5, nftw64@GLIBC_2.2.5, remove
nftw64_2_2_5: .quad 0
.balign 8
.globl nftw64_2_3_3
.type nftw64_2_3_3, %function
.symver nftw64_2_3_3, nftw64@@GLIBC_2.3.3, remove
nftw64_2_3_3: .quad 0
.balign 8
.globl inet6_rth_segments_2_5
.type inet6_rth_segments_2_5, %function
.symver inet6_rth_segments_2_5, inet6_rth_segments@@GLIBC_2.5, remove
inet6_rth_segments_2_5: .quad 0
.balign 8
.globl timerfd_settime_2_8
.type timerfd_settime_2_8, %function
.symver timerfd_settime_2_8, timerfd_settime@@GLIBC_2.8, remove
timerfd_settime_2_8: .quad 0
.balign 8
.globl argz_add_sep_2_2_5
.type argz_add_sep_2_2_5, %function
.symver argz_add_sep_2_2_5, argz_add_sep@@GLIBC_2.2.5, remove
argz_add_sep_2_2_5: .quad 0
.balign 8
.globl fgetwc_2_2_5
.type fgetwc_2_2_5, %function
.symver fgetwc_2_2_5, fgetwc@@GLIBC_2.2.5, remove
fgetwc_2_2_5: .quad 0
.balign 8
.globl netname2user_2_2_5
.type netname2user_2_2_5, %function
.symver netname2user_2_2_5, netname2user@@GLIBC_2.2.5, remove
netname2user_2_2_5: .quad 0
.balign 8
.globl __bsd_getpgrp_2_2_5
.type __bsd_getpgrp_2_2_5, %function
.symver __bsd_getpgrp_2_2_5, __bsd_getpgrp@@GLIBC_2.2.5, remove
__bsd_getpgrp_2_2_5: .quad 0
.balign 8
.globl erand48_r_2_2_5
.type erand48_r_2_2_5, %function
.symver erand48_r_2_2_5, erand48_r@@GLIBC_2.2.5, remove
erand48_r_2_2_5: .quad 0
.balign 8
.globl __wcsncpy_chk_2_4
.type __wcsncpy_chk_2_4, %function
.symver __wcsncpy_chk_2_4, __wcsncpy_chk@@GLIBC_2.4, remove
__wcsncpy_chk_2_4: .quad 0
.balign 8
.globl fgets_unlocked_2_2_5
.type fgets_unlocked_2_2_5, %function
.symver fgets_unlocked_2_2_5, fgets_unlocked@@GLIBC_2.2.5, remove
fgets_unlocked_2_2_5: .quad 0
.balign 8
.globl strncasecmp_l_2_3
.type strncasecmp_l_2_3, %function
.symver strncasecmp_l_2_3, strncasecmp_l@@GLIBC_2.3, remove
strncasecmp_l_2_3: .quad 0
.balign 8
.globl atol_2_2_5
.type atol_2_2_5, %function
.symver atol_2_2_5, atol@@GLIBC_2.2.5, remove
atol_2_2_5: .quad 0
.balign 8
.globl xdr_keystatus_2_2_5
.type xdr_keystatus_2_2_5, %function
.symver xdr_keystatus_2_2_5, xdr_keystatus@@GLIBC_2.2.5, remove
xdr_keystatus_2_2_5: .quad 0
.balign 8
.globl __fread_chk_2_7
.type __fread_chk_2_7, %function
.symver __fread_chk_2_7, __fread_chk@@GLIBC_2.7, remove
__fread_chk_2_7: .quad 0
.balign 8
.globl strndup_2_2_5
.type strndup_2_2_5, %function
.symver strndup_2_2_5, strndup@@GLIBC_2.2.5, remove
strndup_2_2_5: .quad 0
.balign 8
.globl xdr_uint16_t_2_2_5
.type xdr_uint16_t_2_2_5, %function
.symver xdr_uint16_t_2_2_5, xdr_uint16_t@@GLIBC_2.2.5, remove
xdr_uint16_t_2_2_5: .quad 0
.balign 8
.globl putwc_unlocked_2_2_5
.type putwc_unlocked_2_2_5, %function
.symver putwc_unlocked_2_2_5, putwc_unlocked@@GLIBC_2.2.5, remove
putwc_unlocked_2_2_5: .quad 0
.balign 8
.globl endgrent_2_2_5
.type endgrent_2_2_5, %function
.symver endgrent_2_2_5, endgrent@@GLIBC_2.2.5, remove
endgrent_2_2_5: .quad 0
.balign 8
.globl _IO_popen_2_2_5
.type _IO_popen_2_2_5, %function
.symver _IO_popen_2_2_5, _IO_popen@@GLIBC_2.2.5, remove
_IO_popen_2_2_5: .quad 0
.balign 8
.globl fputws_2_2_5
.type fputws_2_2_5, %function
.symver fputws_2_2_5, fputws@@GLIBC_2.2.5, remove
fputws_2_2_5: .quad 0
.balign 8
.globl __wprintf_chk_2_4
.type __wprintf_chk_2_4, %function
.symver __wprintf_chk_2_4, __wprintf_chk@@GLIBC_2.4, remove
__wprintf_chk_2_4: .quad 0
.balign 8
.globl endspent_2_2_5
.type endspent_2_2_5, %function
.symver endspent_2_2_5, endspent@@GLIBC_2.2.5, remove
endspent_2_2_5: .quad 0
.balign 8
.globl cfree_2_2_5
.type cfree_2_2_5, %function
.symver cfree_2_2_5, cfree@@GLIBC_2.2.5, remove
cfree_2_2_5: .quad 0
.balign 8
.globl getpgid_2_2_5
.type getpgid_2_2_5, %function
.symver getpgid_2_2_5, getpgid@@GLIBC_2.2.5, remove
getpgid_2_2_5: .quad 0
.balign 8
.globl getpwnam_2_2_5
.type getpwnam_2_2_5, %function
.symver getpwnam_2_2_5, getpwnam@@GLIBC_2.2.5, remove
getpwnam_2_2_5: .quad 0
.balign 8
.globl init_module_2_2_5
.type init_module_2_2_5, %function
.symver init_module_2_2_5, init_module@@GLIBC_2.2.5, remove
init_module_2_2_5: .quad 0
.balign 8
.globl __h_errno_location_2_2_5
.type __h_errno_location_2_2_5, %function
.symver __h_errno_location_2_2_5, __h_errno_location@@GLIBC_2.2.5, remove
__h_errno_location_2_2_5: .quad 0
.balign 8
.globl isdigit_2_2_5
.type isdigit_2_2_5, %function
.symver isdigit_2_2_5, isdigit@@GLIBC_2.2.5, remove
isdigit_2_2_5: .quad 0
.balign 8
.globl c16rtomb_2_16
.type c16rtomb_2_16, %function
.symver c16rtomb_2_16, c16rtomb@@GLIBC_2.16, remove
c16rtomb_2_16: .quad 0
.balign 8
.globl inet6_rth_getaddr_2_5
.type inet6_rth_getaddr_2_5, %function
.symver inet6_rth_getaddr_2_5, inet6_rth_getaddr@@GLIBC_2.5, remove
inet6_rth_getaddr_2_5: .quad 0
.balign 8
.globl ldexp_2_2_5
.type ldexp_2_2_5, %function
.symver ldexp_2_2_5, ldexp@@GLIBC_2.2.5, remove
ldexp_2_2_5: .quad 0
.balign 8
.globl getfsspec_2_2_5
.type getfsspec_2_2_5, %function
.symver getfsspec_2_2_5, getfsspec@@GLIBC_2.2.5, remove
getfsspec_2_2_5: .quad 0
.balign 8
.globl __isinfl_2_2_5
.type __isinfl_2_2_5, %function
.symver __isinfl_2_2_5, __isinfl@@GLIBC_2.2.5, remove
__isinfl_2_2_5: .quad 0
.balign 8
.globl _IO_setb_2_2_5
.type _IO_setb_2_2_5, %function
.symver _IO_setb_2_2_5, _IO_setb@@GLIBC_2.2.5, remove
_IO_setb_2_2_5: .quad 0
.balign 8
.globl __xpg_sigpause_2_2_5
.type __xpg_sigpause_2_2_5, %function
.symver __xpg_sigpause_2_2_5, __xpg_sigpause@@GLIBC_2.2.5, remove
__xpg_sigpause_2_2_5: .quad 0
.balign 8
.globl lchown_2_2_5
.type lchown_2_2_5, %function
.symver lchown_2_2_5, lchown@@GLIBC_2.2.5, remove
lchown_2_2_5: .quad 0
.balign 8
.globl _IO_fprintf_2_2_5
.type _IO_fprintf_2_2_5, %function
.symver _IO_fprintf_2_2_5, _IO_fprintf@@GLIBC_2.2.5, remove
_IO_fprintf_2_2_5: .quad 0
.balign 8
.globl isdigit_l_2_3
.type isdigit_l_2_3, %function
.symver isdigit_l_2_3, isdigit_l@@GLIBC_2.3, remove
isdigit_l_2_3: .quad 0
.balign 8
.globl lremovexattr_2_3
.type lremovexattr_2_3, %function
.symver lremovexattr_2_3, lremovexattr@@GLIBC_2.3, remove
lremovexattr_2_3: .quad 0
.balign 8
.globl _IO_iter_end_2_2_5
.type _IO_iter_end_2_2_5, %function
.symver _IO_iter_end_2_2_5, _IO_iter_end@@GLIBC_2.2.5, remove
_IO_iter_end_2_2_5: .quad 0
.balign 8
.globl pmap_getport_2_2_5
.type pmap_getport_2_2_5, %function
.symver pmap_getport_2_2_5, pmap_getport@@GLIBC_2.2.5, remove
pmap_getport_2_2_5: .quad 0
.balign 8
.globl pthread_attr_getscope_2_2_5
.type pthread_attr_getscope_2_2_5, %function
.symver pthread_attr_getscope_2_2_5, pthread_attr_getscope@@GLIBC_2.2.5, remove
pthread_attr_getscope_2_2_5: .quad 0
.balign 8
.globl mkstemps64_2_11
.type mkstemps64_2_11, %function
.symver mkstemps64_2_11, mkstemps64@@GLIBC_2.11, remove
mkstemps64_2_11: .quad 0
.balign 8
.globl netname2host_2_2_5
.type netname2host_2_2_5, %function
.symver netname2host_2_2_5, netname2host@@GLIBC_2.2.5, remove
netname2host_2_2_5: .quad 0
.balign 8
.globl __rpc_thread_svc_fdset_2_2_5
.type __rpc_thread_svc_fdset_2_2_5, %function
.symver __rpc_thread_svc_fdset_2_2_5, __rpc_thread_svc_fdset@@GLIBC_2.2.5, remove
__rpc_thread_svc_fdset_2_2_5: .quad 0
.balign 8
.globl ferror_2_2_5
.type ferror_2_2_5, %function
.symver ferror_2_2_5, ferror@@GLIBC_2.2.5, remove
ferror_2_2_5: .quad 0
.balign 8
.globl shmctl_2_2_5
.type shmctl_2_2_5, %function
.symver shmctl_2_2_5, shmctl@@GLIBC_2.2.5, remove
shmctl_2_2_5: .quad 0
.balign 8
.globl getservbyport_r_2_2_5
.type getservbyport_r_2_2_5, %function
.symver getservbyport_r_2_2_5, getservbyport_r@@GLIBC_2.2.5, remove
getservbyport_r_2_2_5: .quad 0
.balign 8
.globl argz_insert_2_2_5
.type argz_insert_2_2_5, %function
.symver argz_insert_2_2_5, argz_insert@@GLIBC_2.2.5, remove
argz_insert_2_2_5: .quad 0
.balign 8
.globl _flushlbf_2_2_5
.type _flushlbf_2_2_5, %function
.symver _flushlbf_2_2_5, _flushlbf@@GLIBC_2.2.5, remove
_flushlbf_2_2_5: .quad 0
.balign 8
.globl scalbnf_2_2_5
.type scalbnf_2_2_5, %function
.symver scalbnf_2_2_5, scalbnf@@GLIBC_2.2.5, remove
scalbnf_2_2_5: .quad 0
.balign 8
.globl __libc_mallinfo_2_2_5
.type __libc_mallinfo_2_2_5, %function
.symver __libc_mallinfo_2_2_5, __libc_mallinfo@@GLIBC_2.2.5, remove
__libc_mallinfo_2_2_5: .quad 0
.balign 8
.globl setstate_r_2_2_5
.type setstate_r_2_2_5, %function
.symver setstate_r_2_2_5, setstate_r@@GLIBC_2.2.5, remove
setstate_r_2_2_5: .quad 0
.balign 8
.globl inotify_init1_2_9
.type inotify_init1_2_9, %function
.symver inotify_init1_2_9, inotify_init1@@GLIBC_2.9, remove
inotify_init1_2_9: .quad 0
.balign 8
.globl _longjmp_2_2_5
.type _longjmp_2_2_5, %function
.symver _longjmp_2_2_5, _longjmp@@GLIBC_2.2.5, remove
_longjmp_2_2_5: .quad 0
.balign 8
.globl bcopy_2_2_5
.type bcopy_2_2_5, %function
.symver bcopy_2_2_5, bcopy@@GLIBC_2.2.5, remove
bcopy_2_2_5: .quad 0
.balign 8
.globl putpmsg_2_2_5
.type putpmsg_2_2_5, %function
.symver putpmsg_2_2_5, putpmsg@@GLIBC_2.2.5, remove
putpmsg_2_2_5: .quad 0
.balign 8
.globl svcerr_noproc_2_2_5
.type svcerr_noproc_2_2_5, %function
.symver svcerr_noproc_2_2_5, svcerr_noproc@@GLIBC_2.2.5, remove
svcerr_noproc_2_2_5: .quad 0
.balign 8
.globl xdr_authunix_parms_2_2_5
.type xdr_authunix_parms_2_2_5, %function
.symver xdr_authunix_parms_2_2_5, xdr_authunix_parms@@GLIBC_2.2.5, remove
xdr_authunix_parms_2_2_5: .quad 0
.balign 8
.globl sched_setscheduler_2_2_5
.type sched_setscheduler_2_2_5, %function
.symver sched_setscheduler_2_2_5, sched_setscheduler@@GLIBC_2.2.5, remove
sched_setscheduler_2_2_5: .quad 0
.balign 8
.globl regfree_2_2_5
.type regfree_2_2_5, %function
.symver regfree_2_2_5, regfree@@GLIBC_2.2.5, remove
regfree_2_2_5: .quad 0
.balign 8
.globl __write_2_2_5
.type __write_2_2_5, %function
.symver __write_2_2_5, __write@@GLIBC_2.2.5, remove
__write_2_2_5: .quad 0
.balign 8
.globl posix_spawnattr_getschedparam_2_2_5
.type posix_spawnattr_getschedparam_2_2_5, %function
.symver posix_spawnattr_getschedparam_2_2_5, posix_spawnattr_getschedparam@@GLIBC_2.2.5, remove
posix_spawnattr_getschedparam_2_2_5: .quad 0
.balign 8
.globl rand_r_2_2_5
.type rand_r_2_2_5, %function
.symver rand_r_2_2_5, rand_r@@GLIBC_2.2.5, remove
rand_r_2_2_5: .quad 0
.balign 8
.globl putpwent_2_2_5
.type putpwent_2_2_5, %function
.symver putpwent_2_2_5, putpwent@@GLIBC_2.2.5, remove
putpwent_2_2_5: .quad 0
.balign 8
.globl reboot_2_2_5
.type reboot_2_2_5, %function
.symver reboot_2_2_5, reboot@@GLIBC_2.2.5, remove
reboot_2_2_5: .quad 0
.balign 8
.globl __libc_start_main_2_2_5
.type __libc_start_main_2_2_5, %function
.symver __libc_start_main_2_2_5, __libc_start_main@@GLIBC_2.2.5, remove
__libc_start_main_2_2_5: .quad 0
.balign 8
.globl strtof_l_2_3
.type strtof_l_2_3, %function
.symver strtof_l_2_3, strtof_l@@GLIBC_2.3, remove
strtof_l_2_3: .quad 0
.balign 8
.globl __libc_current_sigrtmax_2_2_5
.type __libc_current_sigrtmax_2_2_5, %function
.symver __libc_current_sigrtmax_2_2_5, __libc_current_sigrtmax@@GLIBC_2.2.5, remove
__libc_current_sigrtmax_2_2_5: .quad 0
.balign 8
.globl __poll_chk_2_16
.type __poll_chk_2_16, %function
.symver __poll_chk_2_16, __poll_chk@@GLIBC_2.16, remove
__poll_chk_2_16: .quad 0
.balign 8
.globl re_exec_2_2_5
.type re_exec_2_2_5, %function
.symver re_exec_2_2_5, re_exec@@GLIBC_2.2.5, remove
re_exec_2_2_5: .quad 0
.balign 8
.globl ctermid_2_2_5
.type ctermid_2_2_5, %function
.symver ctermid_2_2_5, ctermid@@GLIBC_2.2.5, remove
ctermid_2_2_5: .quad 0
.balign 8
.globl hcreate_r_2_2_5
.type hcreate_r_2_2_5, %function
.symver hcreate_r_2_2_5, hcreate_r@@GLIBC_2.2.5, remove
hcreate_r_2_2_5: .quad 0
.balign 8
.globl __waitpid_2_2_5
.type __waitpid_2_2_5, %function
.symver __waitpid_2_2_5, __waitpid@@GLIBC_2.2.5, remove
__waitpid_2_2_5: .quad 0
.balign 8
.globl mtrace_2_2_5
.type mtrace_2_2_5, %function
.symver mtrace_2_2_5, mtrace@@GLIBC_2.2.5, remove
mtrace_2_2_5: .quad 0
.balign 8
.globl iswprint_2_2_5
.type iswprint_2_2_5, %function
.symver iswprint_2_2_5, iswprint@@GLIBC_2.2.5, remove
iswprint_2_2_5: .quad 0
.balign 8
.globl ptsname_2_2_5
.type ptsname_2_2_5, %function
.symver ptsname_2_2_5, ptsname@@GLIBC_2.2.5, remove
ptsname_2_2_5: .quad 0
.balign 8
.globl setegid_2_2_5
.type setegid_2_2_5, %function
.symver setegid_2_2_5, setegid@@GLIBC_2.2.5, remove
setegid_2_2_5: .quad 0
.balign 8
.globl __dprintf_chk_2_8
.type __dprintf_chk_2_8, %function
.symver __dprintf_chk_2_8, __dprintf_chk@@GLIBC_2.8, remove
__dprintf_chk_2_8: .quad 0
.balign 8
.globl _IO_file_seekoff_2_2_5
.type _IO_file_seekoff_2_2_5, %function
.symver _IO_file_seekoff_2_2_5, _IO_file_seekoff@@GLIBC_2.2.5, remove
_IO_file_seekoff_2_2_5: .quad 0
.balign 8
.globl siginterrupt_2_2_5
.type siginterrupt_2_2_5, %function
.symver siginterrupt_2_2_5, siginterrupt@@GLIBC_2.2.5, remove
siginterrupt_2_2_5: .quad 0
.balign 8
.globl sendmsg_2_2_5
.type sendmsg_2_2_5, %function
.symver sendmsg_2_2_5, sendmsg@@GLIBC_2.2.5, remove
sendmsg_2_2_5: .quad 0
.balign 8
.globl fmtmsg_2_2_5
.type fmtmsg_2_2_5, %function
.symver fmtmsg_2_2_5, fmtmsg@@GLIBC_2.2.5, remove
fmtmsg_2_2_5: .quad 0
.balign 8
.globl capget_2_2_5
.type capget_2_2_5, %function
.symver capget_2_2_5, capget@@GLIBC_2.2.5, remove
capget_2_2_5: .quad 0
.balign 8
.globl __fgetws_chk_2_4
.type __fgetws_chk_2_4, %function
.symver __fgetws_chk_2_4, __fgetws_chk@@GLIBC_2.4, remove
__fgetws_chk_2_4: .quad 0
.balign 8
.globl getrpcport_2_2_5
.type getrpcport_2_2_5, %function
.symver getrpcport_2_2_5, getrpcport@@GLIBC_2.2.5, remove
getrpcport_2_2_5: .quad 0
.balign 8
.globl wcpncpy_2_2_5
.type wcpncpy_2_2_5, %function
.symver wcpncpy_2_2_5, wcpncpy@@GLIBC_2.2.5, remove
wcpncpy_2_2_5: .quad 0
.balign 8
.globl if_freenameindex_2_2_5
.type if_freenameindex_2_2_5, %function
.symver if_freenameindex_2_2_5, if_freenameindex@@GLIBC_2.2.5, remove
if_freenameindex_2_2_5: .quad 0
.balign 8
.globl tcgetsid_2_2_5
.type tcgetsid_2_2_5, %function
.symver tcgetsid_2_2_5, tcgetsid@@GLIBC_2.2.5, remove
tcgetsid_2_2_5: .quad 0
.balign 8
.globl __wcscoll_l_2_2_5
.type __wcscoll_l_2_2_5, %function
.symver __wcscoll_l_2_2_5, __wcscoll_l@@GLIBC_2.2.5, remove
__wcscoll_l_2_2_5: .quad 0
.balign 8
.globl eaccess_2_4
.type eaccess_2_4, %function
.symver eaccess_2_4, eaccess@@GLIBC_2.4, remove
eaccess_2_4: .quad 0
.balign 8
.globl setns_2_14
.type setns_2_14, %function
.symver setns_2_14, setns@@GLIBC_2.14, remove
setns_2_14: .quad 0
.balign 8
.globl clnttcp_create_2_2_5
.type clnttcp_create_2_2_5, %function
.symver clnttcp_create_2_2_5, clnttcp_create@@GLIBC_2.2.5, remove
clnttcp_create_2_2_5: .quad 0
.balign 8
.globl __sched_setscheduler_2_2_5
.type __sched_setscheduler_2_2_5, %function
.symver __sched_setscheduler_2_2_5, __sched_setscheduler@@GLIBC_2.2.5, remove
__sched_setscheduler_2_2_5: .quad 0
.balign 8
.globl isxdigit_l_2_3
.type isxdigit_l_2_3, %function
.symver isxdigit_l_2_3, isxdigit_l@@GLIBC_2.3, remove
isxdigit_l_2_3: .quad 0
.balign 8
.globl mincore_2_2_5
.type mincore_2_2_5, %function
.symver mincore_2_2_5, mincore@@GLIBC_2.2.5, remove
mincore_2_2_5: .quad 0
.balign 8
.globl __ctype_get_mb_cur_max_2_2_5
.type __ctype_get_mb_cur_max_2_2_5, %function
.symver __ctype_get_mb_cur_max_2_2_5, __ctype_get_mb_cur_max@@GLIBC_2.2.5, remove
__ctype_get_mb_cur_max_2_2_5: .quad 0
.balign 8
.globl tmpnam_r_2_2_5
.type tmpnam_r_2_2_5, %function
.symver tmpnam_r_2_2_5, tmpnam_r@@GLIBC_2.2.5, remove
tmpnam_r_2_2_5: .quad 0
.balign 8
.globl iswalpha_l_2_3
.type iswalpha_l_2_3, %function
.symver iswalpha_l_2_3, iswalpha_l@@GLIBC_2.3, remove
iswalpha_l_2_3: .quad 0
.balign 8
.globl _IO_flockfile_2_2_5
.type _IO_flockfile_2_2_5, %function
.symver _IO_flockfile_2_2_5, _IO_flockfile@@GLIBC_2.2.5, remove
_IO_flockfile_2_2_5: .quad 0
.balign 8
.globl pathconf_2_2_5
.type pathconf_2_2_5, %function
.symver pathconf_2_2_5, pathconf@@GLIBC_2.2.5, remove
pathconf_2_2_5: .quad 0
.balign 8
.globl strnlen_2_2_5
.type strnlen_2_2_5, %function
.symver strnlen_2_2_5, strnlen@@GLIBC_2.2.5, remove
strnlen_2_2_5: .quad 0
.balign 8
.globl statvfs_2_2_5
.type statvfs_2_2_5, %function
.symver statvfs_2_2_5, statvfs@@GLIBC_2.2.5, remove
statvfs_2_2_5: .quad 0
.balign 8
.globl re_comp_2_2_5
.type re_comp_2_2_5, %function
.symver re_comp_2_2_5, re_comp@@GLIBC_2.2.5, remove
re_comp_2_2_5: .quad 0
.balign 8
.globl getwc_unlocked_2_2_5
.type getwc_unlocked_2_2_5, %function
.symver getwc_unlocked_2_2_5, getwc_unlocked@@GLIBC_2.2.5, remove
getwc_unlocked_2_2_5: .quad 0
.balign 8
.globl __isxdigit_l_2_2_5
.type __isxdigit_l_2_2_5, %function
.symver __isxdigit_l_2_2_5, __isxdigit_l@@GLIBC_2.2.5, remove
__isxdigit_l_2_2_5: .quad 0
.balign 8
.globl getdelim_2_2_5
.type getdelim_2_2_5, %function
.symver getdelim_2_2_5, getdelim@@GLIBC_2.2.5, remove
getdelim_2_2_5: .quad 0
.balign 8
.globl setdomainname_2_2_5
.type setdomainname_2_2_5, %function
.symver setdomainname_2_2_5, setdomainname@@GLIBC_2.2.5, remove
setdomainname_2_2_5: .quad 0
.balign 8
.globl getresgid_2_2_5
.type getresgid_2_2_5, %function
.symver getresgid_2_2_5, getresgid@@GLIBC_2.2.5, remove
getresgid_2_2_5: .quad 0
.balign 8
.globl inet_netof_2_2_5
.type inet_netof_2_2_5, %function
.symver inet_netof_2_2_5, inet_netof@@GLIBC_2.2.5, remove
inet_netof_2_2_5: .quad 0
.balign 8
.globl gethostbyname2_r_2_2_5
.type gethostbyname2_r_2_2_5, %function
.symver gethostbyname2_r_2_2_5, gethostbyname2_r@@GLIBC_2.2.5, remove
gethostbyname2_r_2_2_5: .quad 0
.balign 8
.globl closelog_2_2_5
.type closelog_2_2_5, %function
.symver closelog_2_2_5, closelog@@GLIBC_2.2.5, remove
closelog_2_2_5: .quad 0
.balign 8
.globl _IO_seekoff_2_2_5
.type _IO_seekoff_2_2_5, %function
.symver _IO_seekoff_2_2_5, _IO_seekoff@@GLIBC_2.2.5, remove
_IO_seekoff_2_2_5: .quad 0
.balign 8
.globl renameat_2_4
.type renameat_2_4, %function
.symver renameat_2_4, renameat@@GLIBC_2.4, remove
renameat_2_4: .quad 0
.balign 8
.globl pthread_attr_setinheritsched_2_2_5
.type pthread_attr_setinheritsched_2_2_5, %function
.symver pthread_attr_setinheritsched_2_2_5, pthread_attr_setinheritsched@@GLIBC_2.2.5, remove
pthread_attr_setinheritsched_2_2_5: .quad 0
.balign 8
.globl pthread_mutex_init_2_2_5
.type pthread_mutex_init_2_2_5, %function
.symver pthread_mutex_init_2_2_5, pthread_mutex_init@@GLIBC_2.2.5, remove
pthread_mutex_init_2_2_5: .quad 0
.balign 8
.globl ffsll_2_2_5
.type ffsll_2_2_5, %function
.symver ffsll_2_2_5, ffsll@@GLIBC_2.2.5, remove
ffsll_2_2_5: .quad 0
.balign 8
.globl _IO_file_stat_2_2_5
.type _IO_file_stat_2_2_5, %function
.symver _IO_file_stat_2_2_5, _IO_file_stat@@GLIBC_2.2.5, remove
_IO_file_stat_2_2_5: .quad 0
.balign 8
.globl getnetname_2_2_5
.type getnetname_2_2_5, %function
.symver getnetname_2_2_5, getnetname@@GLIBC_2.2.5, remove
getnetname_2_2_5: .quad 0
.balign 8
.globl swapoff_2_2_5
.type swapoff_2_2_5, %function
.symver swapoff_2_2_5, swapoff@@GLIBC_2.2.5, remove
swapoff_2_2_5: .quad 0
.balign 8
.globl times_2_2_5
.type times_2_2_5, %function
.symver times_2_2_5, times@@GLIBC_2.2.5, remove
times_2_2_5: .quad 0
.balign 8
.globl _IO_setbuffer_2_2_5
.type _IO_setbuffer_2_2_5, %function
.symver _IO_setbuffer_2_2_5, _IO_setbuffer@@GLIBC_2.2.5, remove
_IO_setbuffer_2_2_5: .quad 0
.balign 8
.globl gets_2_2_5
.type gets_2_2_5, %function
.symver gets_2_2_5, gets@@GLIBC_2.2.5, remove
gets_2_2_5: .quad 0
.balign 8
.globl pthread_equal_2_2_5
.type pthread_equal_2_2_5, %function
.symver pthread_equal_2_2_5, pthread_equal@@GLIBC_2.2.5, remove
pthread_equal_2_2_5: .quad 0
.balign 8
.globl query_module_2_2_5
.type query_module_2_2_5, %function
.symver query_module_2_2_5, query_module@@GLIBC_2.2.5, remove
query_module_2_2_5: .quad 0
.balign 8
.globl monstartup_2_2_5
.type monstartup_2_2_5, %function
.symver monstartup_2_2_5, monstartup@@GLIBC_2.2.5, remove
monstartup_2_2_5: .quad 0
.balign 8
.globl pmap_rmtcall_2_2_5
.type pmap_rmtcall_2_2_5, %function
.symver pmap_rmtcall_2_2_5, pmap_rmtcall@@GLIBC_2.2.5, remove
pmap_rmtcall_2_2_5: .quad 0
.balign 8
.globl seteuid_2_2_5
.type seteuid_2_2_5, %function
.symver seteuid_2_2_5, seteuid@@GLIBC_2.2.5, remove
seteuid_2_2_5: .quad 0
.balign 8
.globl _IO_str_underflow_2_2_5
.type _IO_str_underflow_2_2_5, %function
.symver _IO_str_underflow_2_2_5, _IO_str_underflow@@GLIBC_2.2.5, remove
_IO_str_underflow_2_2_5: .quad 0
.balign 8
.globl _IO_ungetc_2_2_5
.type _IO_ungetc_2_2_5, %function
.symver _IO_ungetc_2_2_5, _IO_ungetc@@GLIBC_2.2.5, remove
_IO_ungetc_2_2_5: .quad 0
.balign 8
.globl __libc_memalign_2_2_5
.type __libc_memalign_2_2_5, %function
.symver __libc_memalign_2_2_5, __libc_memalign@@GLIBC_2.2.5, remove
__libc_memalign_2_2_5: .quad 0
.balign 8
.globl sigreturn_2_2_5
.type sigreturn_2_2_5, %function
.symver sigreturn_2_2_5, sigreturn@@GLIBC_2.2.5, remove
sigreturn_2_2_5: .quad 0
.balign 8
.globl _IO_switch_to_main_wget_area_2_2_5
.type _IO_switch_to_main_wget_area_2_2_5, %function
.symver _IO_switch_to_main_wget_area_2_2_5, _IO_switch_to_main_wget_area@@GLIBC_2.2.5, remove
_IO_switch_to_main_wget_area_2_2_5: .quad 0
.balign 8
.globl posix_spawnattr_getsigmask_2_2_5
.type posix_spawnattr_getsigmask_2_2_5, %function
.symver posix_spawnattr_getsigmask_2_2_5, posix_spawnattr_getsigmask@@GLIBC_2.2.5, remove
posix_spawnattr_getsigmask_2_2_5: .quad 0
.balign 8
.globl dup2_2_2_5
.type dup2_2_2_5, %function
.symver dup2_2_2_5, dup2@@GLIBC_2.2.5, remove
dup2_2_2_5: .quad 0
.balign 8
.globl __sysconf_2_2_5
.type __sysconf_2_2_5, %function
.symver __sysconf_2_2_5, __sysconf@@GLIBC_2.2.5, remove
__sysconf_2_2_5: .quad 0
.balign 8
.globl sprofil_2_2_5
.type sprofil_2_2_5, %function
.symver sprofil_2_2_5, sprofil@@GLIBC_2.2.5, remove
sprofil_2_2_5: .quad 0
.balign 8
.globl clock_settime_2_17
.type clock_settime_2_17, %function
.symver clock_settime_2_17, clock_settime@@GLIBC_2.17, remove
clock_settime_2_17: .quad 0
.balign 8
.globl _IO_sgetn_2_2_5
.type _IO_sgetn_2_2_5, %function
.symver _IO_sgetn_2_2_5, _IO_sgetn@@GLIBC_2.2.5, remove
_IO_sgetn_2_2_5: .quad 0
.balign 8
.globl __strtok_r_2_2_5
.type __strtok_r_2_2_5, %function
.symver __strtok_r_2_2_5, __strtok_r@@GLIBC_2.2.5, remove
__strtok_r_2_2_5: .quad 0
.balign 8
.globl imaxabs_2_2_5
.type imaxabs_2_2_5, %function
.symver imaxabs_2_2_5, imaxabs@@GLIBC_2.2.5, remove
imaxabs_2_2_5: .quad 0
.balign 8
.globl getlogin_2_2_5
.type getlogin_2_2_5, %function
.symver getlogin_2_2_5, getlogin@@GLIBC_2.2.5, remove
getlogin_2_2_5: .quad 0
.balign 8
.globl _IO_sputbackc_2_2_5
.type _IO_sputbackc_2_2_5, %function
.symver _IO_sputbackc_2_2_5, _IO_sputbackc@@GLIBC_2.2.5, remove
_IO_sputbackc_2_2_5: .quad 0
.balign 8
.globl wcstod_l_2_3
.type wcstod_l_2_3, %function
.symver wcstod_l_2_3, wcstod_l@@GLIBC_2.3, remove
wcstod_l_2_3: .quad 0
.balign 8
.globl posix_fallocate_2_2_5
.type posix_fallocate_2_2_5, %function
.symver posix_fallocate_2_2_5, posix_fallocate@@GLIBC_2.2.5, remove
posix_fallocate_2_2_5: .quad 0
.balign 8
.globl inet_ntoa_2_2_5
.type inet_ntoa_2_2_5, %function
.symver inet_ntoa_2_2_5, inet_ntoa@@GLIBC_2.2.5, remove
inet_ntoa_2_2_5: .quad 0
.balign 8
.globl psiginfo_2_10
.type psiginfo_2_10, %function
.symver psiginfo_2_10, psiginfo@@GLIBC_2.10, remove
psiginfo_2_10: .quad 0
.balign 8
.globl herror_2_2_5
.type herror_2_2_5, %function
.symver herror_2_2_5, herror@@GLIBC_2.2.5, remove
herror_2_2_5: .quad 0
.balign 8
.globl __libc_valloc_2_2_5
.type __libc_valloc_2_2_5, %function
.symver __libc_valloc_2_2_5, __libc_valloc@@GLIBC_2.2.5, remove
__libc_valloc_2_2_5: .quad 0
.balign 8
.globl wcscoll_l_2_3
.type wcscoll_l_2_3, %function
.symver wcscoll_l_2_3, wcscoll_l@@GLIBC_2.3, remove
wcscoll_l_2_3: .quad 0
.balign 8
.globl __snprintf_chk_2_3_4
.type __snprintf_chk_2_3_4, %function
.symver __snprintf_chk_2_3_4, __snprintf_chk@@GLIBC_2.3.4, remove
__snprintf_chk_2_3_4: .quad 0
.balign 8
.globl __strcasecmp_2_2_5
.type __strcasecmp_2_2_5, %function
.symver __strcasecmp_2_2_5, __strcasecmp@@GLIBC_2.2.5, remove
__strcasecmp_2_2_5: .quad 0
.balign 8
.globl getprotobynumber_2_2_5
.type getprotobynumber_2_2_5, %function
.symver getprotobynumber_2_2_5, getprotobynumber@@GLIBC_2.2.5, remove
getprotobynumber_2_2_5: .quad 0
.balign 8
.globl getcontext_2_2_5
.type getcontext_2_2_5, %function
.symver getcontext_2_2_5, getcontext@@GLIBC_2.2.5, remove
getcontext_2_2_5: .quad 0
.balign 8
.globl key_decryptsession_2_2_5
.type key_decryptsession_2_2_5, %function
.symver key_decryptsession_2_2_5, key_decryptsession@@GLIBC_2.2.5, remove
key_decryptsession_2_2_5: .quad 0
.balign 8
.globl posix_spawnattr_setflags_2_2_5
.type posix_spawnattr_setflags_2_2_5, %function
.symver posix_spawnattr_setflags_2_2_5, posix_spawnattr_setflags@@GLIBC_2.2.5, remove
posix_spawnattr_setflags_2_2_5: .quad 0
.balign 8
.globl _IO_str_init_static_2_2_5
.type _IO_str_init_static_2_2_5, %function
.symver _IO_str_init_static_2_2_5, _IO_str_init_static@@GLIBC_2.2.5, remove
_IO_str_init_static_2_2_5: .quad 0
.balign 8
.globl basename_2_2_5
.type basename_2_2_5, %function
.symver basename_2_2_5, basename@@GLIBC_2.2.5, remove
basename_2_2_5: .quad 0
.balign 8
.globl fwide_2_2_5
.type fwide_2_2_5, %function
.symver fwide_2_2_5, fwide@@GLIBC_2.2.5, remove
fwide_2_2_5: .quad 0
.balign 8
.globl getnetbyaddr_2_2_5
.type getnetbyaddr_2_2_5, %function
.symver getnetbyaddr_2_2_5, getnetbyaddr@@GLIBC_2.2.5, remove
getnetbyaddr_2_2_5: .quad 0
.balign 8
.globl pthread_mutex_destroy_2_2_5
.type pthread_mutex_destroy_2_2_5, %function
.symver pthread_mutex_destroy_2_2_5, pthread_mutex_destroy@@GLIBC_2.2.5, remove
pthread_mutex_destroy_2_2_5: .quad 0
.balign 8
.globl __isctype_2_3
.type __isctype_2_3, %function
.symver __isctype_2_3, __isctype@@GLIBC_2.3, remove
__isctype_2_3: .quad 0
.balign 8
.globl sigaltstack_2_2_5
.type sigaltstack_2_2_5, %function
.symver sigaltstack_2_2_5, sigaltstack@@GLIBC_2.2.5, remove
sigaltstack_2_2_5: .quad 0
.balign 8
.globl scandir_2_2_5
.type scandir_2_2_5, %function
.symver scandir_2_2_5, scandir@@GLIBC_2.2.5, remove
scandir_2_2_5: .quad 0
.balign 8
.globl ferror_unlocked_2_2_5
.type ferror_unlocked_2_2_5, %function
.symver ferror_unlocked_2_2_5, ferror_unlocked@@GLIBC_2.2.5, remove
ferror_unlocked_2_2_5: .quad 0
.balign 8
.globl ftello64_2_2_5
.type ftello64_2_2_5, %function
.symver ftello64_2_2_5, ftello64@@GLIBC_2.2.5, remove
ftello64_2_2_5: .quad 0
.balign 8
.globl _setjmp_2_2_5
.type _setjmp_2_2_5, %function
.symver _setjmp_2_2_5, _setjmp@@GLIBC_2.2.5, remove
_setjmp_2_2_5: .quad 0
.balign 8
.globl ntohs_2_2_5
.type ntohs_2_2_5, %function
.symver ntohs_2_2_5, ntohs@@GLIBC_2.2.5, remove
ntohs_2_2_5: .quad 0
.balign 8
.globl __connect_2_2_5
.type __connect_2_2_5, %function
.symver __connect_2_2_5, __connect@@GLIBC_2.2.5, remove
__connect_2_2_5: .quad 0
.balign 8
.globl getline_2_2_5
.type getline_2_2_5, %function
.symver getline_2_2_5, getline@@GLIBC_2.2.5, remove
getline_2_2_5: .quad 0
.balign 8
.globl glob64_2_2_5
.type glob64_2_2_5, %function
.symver glob64_2_2_5, glob64@@GLIBC_2.2.5, remove
glob64_2_2_5: .quad 0
.balign 8
.globl __wcpncpy_chk_2_4
.type __wcpncpy_chk_2_4, %function
.symver __wcpncpy_chk_2_4, __wcpncpy_chk@@GLIBC_2.4, remove
__wcpncpy_chk_2_4: .quad 0
.balign 8
.globl freopen_2_2_5
.type freopen_2_2_5, %function
.symver freopen_2_2_5, freopen@@GLIBC_2.2.5, remove
freopen_2_2_5: .quad 0
.balign 8
.globl fanotify_mark_2_13
.type fanotify_mark_2_13, %function
.symver fanotify_mark_2_13, fanotify_mark@@GLIBC_2.13, remove
fanotify_mark_2_13: .quad 0
.balign 8
.globl __openat_2_2_7
.type __openat_2_2_7, %function
.symver __openat_2_2_7, __openat_2@@GLIBC_2.7, remove
__openat_2_2_7: .quad 0
.balign 8
.globl iswcntrl_l_2_3
.type iswcntrl_l_2_3, %function
.symver iswcntrl_l_2_3, iswcntrl_l@@GLIBC_2.3, remove
iswcntrl_l_2_3: .quad 0
.balign 8
.globl iswupper_l_2_3
.type iswupper_l_2_3, %function
.symver iswupper_l_2_3, iswupper_l@@GLIBC_2.3, remove
iswupper_l_2_3: .quad 0
.balign 8
.globl wcsxfrm_2_2_5
.type wcsxfrm_2_2_5, %function
.symver wcsxfrm_2_2_5, wcsxfrm@@GLIBC_2.2.5, remove
wcsxfrm_2_2_5: .quad 0
.balign 8
.globl __towupper_l_2_2_5
.type __towupper_l_2_2_5, %function
.symver __towupper_l_2_2_5, __towupper_l@@GLIBC_2.2.5, remove
__towupper_l_2_2_5: .quad 0
.balign 8
.globl fcvt_2_2_5
.type fcvt_2_2_5, %function
.symver fcvt_2_2_5, fcvt@@GLIBC_2.2.5, remove
fcvt_2_2_5: .quad 0
.balign 8
.globl __vprintf_chk_2_3_4
.type __vprintf_chk_2_3_4, %function
.symver __vprintf_chk_2_3_4, __vprintf_chk@@GLIBC_2.3.4, remove
__vprintf_chk_2_3_4: .quad 0
.balign 8
.globl _IO_list_lock_2_2_5
.type _IO_list_lock_2_2_5, %function
.symver _IO_list_lock_2_2_5, _IO_list_lock@@GLIBC_2.2.5, remove
_IO_list_lock_2_2_5: .quad 0
.balign 8
.globl pututxline_2_2_5
.type pututxline_2_2_5, %function
.symver pututxline_2_2_5, pututxline@@GLIBC_2.2.5, remove
pututxline_2_2_5: .quad 0
.balign 8
.globl fputwc_2_2_5
.type fputwc_2_2_5, %function
.symver fputwc_2_2_5, fputwc@@GLIBC_2.2.5, remove
fputwc_2_2_5: .quad 0
.balign 8
.globl _IO_sungetwc_2_2_5
.type _IO_sungetwc_2_2_5, %function
.symver _IO_sungetwc_2_2_5, _IO_sungetwc@@GLIBC_2.2.5, remove
_IO_sungetwc_2_2_5: .quad 0
.balign 8
.globl strcasestr_2_2_5
.type strcasestr_2_2_5, %function
.symver strcasestr_2_2_5, strcasestr@@GLIBC_2.2.5, remove
strcasestr_2_2_5: .quad 0
.balign 8
.globl _IO_wdo_write_2_2_5
.type _IO_wdo_write_2_2_5, %function
.symver _IO_wdo_write_2_2_5, _IO_wdo_write@@GLIBC_2.2.5, remove
_IO_wdo_write_2_2_5: .quad 0
.balign 8
.globl llseek_2_2_5
.type llseek_2_2_5, %function
.symver llseek_2_2_5, llseek@@GLIBC_2.2.5, remove
llseek_2_2_5: .quad 0
.balign 8
.globl longjmp_2_2_5
.type longjmp_2_2_5, %function
.symver longjmp_2_2_5, longjmp@@GLIBC_2.2.5, remove
longjmp_2_2_5: .quad 0
.balign 8
.globl malloc_2_2_5
.type malloc_2_2_5, %function
.symver malloc_2_2_5, malloc@@GLIBC_2.2.5, remove
malloc_2_2_5: .quad 0
.balign 8
.globl utime_2_2_5
.type utime_2_2_5, %function
.symver utime_2_2_5, utime@@GLIBC_2.2.5, remove
utime_2_2_5: .quad 0
.balign 8
.globl __strtoull_l_2_2_5
.type __strtoull_l_2_2_5, %function
.symver __strtoull_l_2_2_5, __strtoull_l@@GLIBC_2.2.5, remove
__strtoull_l_2_2_5: .quad 0
.balign 8
.globl __wcsftime_l_2_3
.type __wcsftime_l_2_3, %function
.symver __wcsftime_l_2_3, __wcsftime_l@@GLIBC_2.3, remove
__wcsftime_l_2_3: .quad 0
.balign 8
.globl __xmknodat_2_4
.type __xmknodat_2_4, %function
.symver __xmknodat_2_4, __xmknodat@@GLIBC_2.4, remove
__xmknodat_2_4: .quad 0
.balign 8
.globl __sched_get_priority_min_2_2_5
.type __sched_get_priority_min_2_2_5, %function
.symver __sched_get_priority_min_2_2_5, __sched_get_priority_min@@GLIBC_2.2.5, remove
__sched_get_priority_min_2_2_5: .quad 0
.balign 8
.globl __mempcpy_small_2_2_5
.type __mempcpy_small_2_2_5, %function
.symver __mempcpy_small_2_2_5, __mempcpy_small@@GLIBC_2.2.5, remove
__mempcpy_small_2_2_5: .quad 0
.balign 8
.globl srandom_2_2_5
.type srandom_2_2_5, %function
.symver srandom_2_2_5, srandom@@GLIBC_2.2.5, remove
srandom_2_2_5: .quad 0
.balign 8
.globl alphasort64_2_2_5
.type alphasort64_2_2_5, %function
.symver alphasort64_2_2_5, alphasort64@@GLIBC_2.2.5, remove
alphasort64_2_2_5: .quad 0
.balign 8
.globl cfsetospeed_2_2_5
.type cfsetospeed_2_2_5, %function
.symver cfsetospeed_2_2_5, cfsetospeed@@GLIBC_2.2.5, remove
cfsetospeed_2_2_5: .quad 0
.balign 8
.globl euidaccess_2_2_5
.type euidaccess_2_2_5, %function
.symver euidaccess_2_2_5, euidaccess@@GLIBC_2.2.5, remove
euidaccess_2_2_5: .quad 0
.balign 8
.globl xdr_opaque_2_2_5
.type xdr_opaque_2_2_5, %function
.symver xdr_opaque_2_2_5, xdr_opaque@@GLIBC_2.2.5, remove
xdr_opaque_2_2_5: .quad 0
.balign 8
.globl twalk_2_2_5
.type twalk_2_2_5, %function
.symver twalk_2_2_5, twalk@@GLIBC_2.2.5, remove
twalk_2_2_5: .quad 0
.balign 8
.globl _IO_file_doallocate_2_2_5
.type _IO_file_doallocate_2_2_5, %function
.symver _IO_file_doallocate_2_2_5, _IO_file_doallocate@@GLIBC_2.2.5, remove
_IO_file_doallocate_2_2_5: .quad 0
.balign 8
.globl clnt_perror_2_2_5
.type clnt_perror_2_2_5, %function
.symver clnt_perror_2_2_5, clnt_perror@@GLIBC_2.2.5, remove
clnt_perror_2_2_5: .quad 0
.balign 8
.globl __sigaction_2_2_5
.type __sigaction_2_2_5, %function
.symver __sigaction_2_2_5, __sigaction@@GLIBC_2.2.5, remove
__sigaction_2_2_5: .quad 0
.balign 8
.globl __isascii_l_2_2_5
.type __isascii_l_2_2_5, %function
.symver __isascii_l_2_2_5, __isascii_l@@GLIBC_2.2.5, remove
__isascii_l_2_2_5: .quad 0
.balign 8
.globl __argz_count_2_2_5
.type __argz_count_2_2_5, %function
.symver __argz_count_2_2_5, __argz_count@@GLIBC_2.2.5, remove
__argz_count_2_2_5: .quad 0
.balign 8
.globl adjtimex_2_2_5
.type adjtimex_2_2_5, %function
.symver adjtimex_2_2_5, adjtimex@@GLIBC_2.2.5, remove
adjtimex_2_2_5: .quad 0
.balign 8
.globl _IO_file_overflow_2_2_5
.type _IO_file_overflow_2_2_5, %function
.symver _IO_file_overflow_2_2_5, _IO_file_overflow@@GLIBC_2.2.5, remove
_IO_file_overflow_2_2_5: .quad 0
.balign 8
.globl _IO_flush_all_linebuffered_2_2_5
.type _IO_flush_all_linebuffered_2_2_5, %function
.symver _IO_flush_all_linebuffered_2_2_5, _IO_flush_all_linebuffered@@GLIBC_2.2.5, remove
_IO_flush_all_linebuffered_2_2_5: .quad 0
.balign 8
.globl __fxstat64_2_2_5
.type __fxstat64_2_2_5, %function
.symver __fxstat64_2_2_5, __fxstat64@@GLIBC_2.2.5, remove
__fxstat64_2_2_5: .quad 0
.balign 8
.globl svcerr_noprog_2_2_5
.type svcerr_noprog_2_2_5, %function
.symver svcerr_noprog_2_2_5, svcerr_noprog@@GLIBC_2.2.5, remove
svcerr_noprog_2_2_5: .quad 0
.balign 8
.globl __cxa_atexit_2_2_5
.type __cxa_atexit_2_2_5, %function
.symver __cxa_atexit_2_2_5, __cxa_atexit@@GLIBC_2.2.5, remove
__cxa_atexit_2_2_5: .quad 0
.balign 8
.globl valloc_2_2_5
.type valloc_2_2_5, %function
.symver valloc_2_2_5, valloc@@GLIBC_2.2.5, remove
valloc_2_2_5: .quad 0
.balign 8
.globl abs_2_2_5
.type abs_2_2_5, %function
.symver abs_2_2_5, abs@@GLIBC_2.2.5, remove
abs_2_2_5: .quad 0
.balign 8
.globl atoi_2_2_5
.type atoi_2_2_5, %function
.symver atoi_2_2_5, atoi@@GLIBC_2.2.5, remove
atoi_2_2_5: .quad 0
.balign 8
.globl __open64_2_2_5
.type __open64_2_2_5, %function
.symver __open64_2_2_5, __open64@@GLIBC_2.2.5, remove
__open64_2_2_5: .quad 0
.balign 8
.globl isgraph_l_2_3
.type isgraph_l_2_3, %function
.symver isgraph_l_2_3, isgraph_l@@GLIBC_2.3, remove
isgraph_l_2_3: .quad 0
.balign 8
.globl htonl_2_2_5
.type htonl_2_2_5, %function
.symver htonl_2_2_5, htonl@@GLIBC_2.2.5, remove
htonl_2_2_5: .quad 0
.balign 8
.globl execle_2_2_5
.type execle_2_2_5, %function
.symver execle_2_2_5, execle@@GLIBC_2.2.5, remove
execle_2_2_5: .quad 0
.balign 8
.globl semget_2_2_5
.type semget_2_2_5, %function
.symver semget_2_2_5, semget@@GLIBC_2.2.5, remove
semget_2_2_5: .quad 0
.balign 8
.globl daemon_2_2_5
.type daemon_2_2_5, %function
.symver daemon_2_2_5, daemon@@GLIBC_2.2.5, remove
daemon_2_2_5: .quad 0
.balign 8
.globl getpwuid_r_2_2_5
.type getpwuid_r_2_2_5, %function
.symver getpwuid_r_2_2_5, getpwuid_r@@GLIBC_2.2.5, remove
getpwuid_r_2_2_5: .quad 0
.balign 8
.globl __chk_fail_2_3_4
.type __chk_fail_2_3_4, %function
.symver __chk_fail_2_3_4, __chk_fail@@GLIBC_2.3.4, remove
__chk_fail_2_3_4: .quad 0
.balign 8
.globl mkostemps64_2_11
.type mkostemps64_2_11, %function
.symver mkostemps64_2_11, mkostemps64@@GLIBC_2.11, remove
mkostemps64_2_11: .quad 0
.balign 8
.globl wctype_l_2_3
.type wctype_l_2_3, %function
.symver wctype_l_2_3, wctype_l@@GLIBC_2.3, remove
wctype_l_2_3: .quad 0
.balign 8
.globl _IO_fputs_2_2_5
.type _IO_fputs_2_2_5, %function
.symver _IO_fputs_2_2_5, _IO_fputs@@GLIBC_2.2.5, remove
_IO_fputs_2_2_5: .quad 0
.balign 8
.globl getsgnam_2_10
.type getsgnam_2_10, %function
.symver getsgnam_2_10, getsgnam@@GLIBC_2.10, remove
getsgnam_2_10: .quad 0
.balign 8
.globl _IO_marker_delta_2_2_5
.type _IO_marker_delta_2_2_5, %function
.symver _IO_marker_delta_2_2_5, _IO_marker_delta@@GLIBC_2.2.5, remove
_IO_marker_delta_2_2_5: .quad 0
.balign 8
.globl __assert_fail_2_2_5
.type __assert_fail_2_2_5, %function
.symver __assert_fail_2_2_5, __assert_fail@@GLIBC_2.2.5, remove
__assert_fail_2_2_5: .quad 0
.balign 8
.globl bind_2_2_5
.type bind_2_2_5, %function
.symver bind_2_2_5, bind@@GLIBC_2.2.5, remove
bind_2_2_5: .quad 0
.balign 8
.globl ftw64_2_2_5
.type ftw64_2_2_5, %function
.symver ftw64_2_2_5, ftw64@@GLIBC_2.2.5, remove
ftw64_2_2_5: .quad 0
.balign 8
.globl openat64_2_4
.type openat64_2_4, %function
.symver openat64_2_4, openat64@@GLIBC_2.4, remove
openat64_2_4: .quad 0
.balign 8
.globl isalpha_2_2_5
.type isalpha_2_2_5, %function
.symver isalpha_2_2_5, isalpha@@GLIBC_2.2.5, remove
isalpha_2_2_5: .quad 0
.balign 8
.globl __endmntent_2_2_5
.type __endmntent_2_2_5, %function
.symver __endmntent_2_2_5, __endmntent@@GLIBC_2.2.5, remove
__endmntent_2_2_5: .quad 0
.balign 8
.globl __strspn_c3_2_2_5
.type __strspn_c3_2_2_5, %function
.symver __strspn_c3_2_2_5, __strspn_c3@@GLIBC_2.2.5, remove
__strspn_c3_2_2_5: .quad 0
.balign 8
.globl flock_2_2_5
.type flock_2_2_5, %function
.symver flock_2_2_5, flock@@GLIBC_2.2.5, remove
flock_2_2_5: .quad 0
.balign 8
.globl setrlimit_2_2_5
.type setrlimit_2_2_5, %function
.symver setrlimit_2_2_5, setrlimit@@GLIBC_2.2.5, remove
setrlimit_2_2_5: .quad 0
.balign 8
.globl __woverflow_2_2_5
.type __woverflow_2_2_5, %function
.symver __woverflow_2_2_5, __woverflow@@GLIBC_2.2.5, remove
__woverflow_2_2_5: .quad 0
.balign 8
.globl addseverity_2_2_5
.type addseverity_2_2_5, %function
.symver addseverity_2_2_5, addseverity@@GLIBC_2.2.5, remove
addseverity_2_2_5: .quad 0
.balign 8
.globl shmdt_2_2_5
.type shmdt_2_2_5, %function
.symver shmdt_2_2_5, shmdt@@GLIBC_2.2.5, remove
shmdt_2_2_5: .quad 0
.balign 8
.globl xdr_rejected_reply_2_2_5
.type xdr_rejected_reply_2_2_5, %function
.symver xdr_rejected_reply_2_2_5, xdr_rejected_reply@@GLIBC_2.2.5, remove
xdr_rejected_reply_2_2_5: .quad 0
.balign 8
.globl clone_2_2_5
.type clone_2_2_5, %function
.symver clone_2_2_5, clone@@GLIBC_2.2.5, remove
clone_2_2_5: .quad 0
.balign 8
.globl readlink_2_2_5
.type readlink_2_2_5, %function
.symver readlink_2_2_5, readlink@@GLIBC_2.2.5, remove
readlink_2_2_5: .quad 0
.balign 8
.globl __backtrace_symbols_fd_2_2_5
.type __backtrace_symbols_fd_2_2_5, %function
.symver __backtrace_symbols_fd_2_2_5, __backtrace_symbols_fd@@GLIBC_2.2.5, remove
__backtrace_symbols_fd_2_2_5: .quad 0
.balign 8
.globl strerror_l_2_6
.type strerror_l_2_6, %function
.symver strerror_l_2_6, strerror_l@@GLIBC_2.6, remove
strerror_l_2_6: .quad 0
.balign 8
.globl __getauxval_2_16
.type __getauxval_2_16, %function
.symver __getauxval_2_16, __getauxval@@GLIBC_2.16, remove
__getauxval_2_16: .quad 0
.balign 8
.globl xdr_vector_2_2_5
.type xdr_vector_2_2_5, %function
.symver xdr_vector_2_2_5, xdr_vector@@GLIBC_2.2.5, remove
xdr_vector_2_2_5: .quad 0
.balign 8
.globl xdr_callmsg_2_2_5
.type xdr_callmsg_2_2_5, %function
.symver xdr_callmsg_2_2_5, xdr_callmsg@@GLIBC_2.2.5, remove
xdr_callmsg_2_2_5: .quad 0
.balign 8
.globl rename_2_2_5
.type rename_2_2_5, %function
.symver rename_2_2_5, rename@@GLIBC_2.2.5, remove
rename_2_2_5: .quad 0
.balign 8
.globl fsetxattr_2_3
.type fsetxattr_2_3, %function
.symver fsetxattr_2_3, fsetxattr@@GLIBC_2.3, remove
fsetxattr_2_3: .quad 0
.balign 8
.globl kill_2_2_5
.type kill_2_2_5, %function
.symver kill_2_2_5, kill@@GLIBC_2.2.5, remove
kill_2_2_5: .quad 0
.balign 8
.globl getrpcbynumber_r_2_2_5
.type getrpcbynumber_r_2_2_5, %function
.symver getrpcbynumber_r_2_2_5, getrpcbynumber_r@@GLIBC_2.2.5, remove
getrpcbynumber_r_2_2_5: .quad 0
.balign 8
.globl hdestroy_2_2_5
.type hdestroy_2_2_5, %function
.symver hdestroy_2_2_5, hdestroy@@GLIBC_2.2.5, remove
hdestroy_2_2_5: .quad 0
.balign 8
.globl xdr_keybuf_2_2_5
.type xdr_keybuf_2_2_5, %function
.symver xdr_keybuf_2_2_5, xdr_keybuf@@GLIBC_2.2.5, remove
xdr_keybuf_2_2_5: .quad 0
.balign 8
.globl uname_2_2_5
.type uname_2_2_5, %function
.symver uname_2_2_5, uname@@GLIBC_2.2.5, remove
uname_2_2_5: .quad 0
.balign 8
.globl getsgent_r_2_10
.type getsgent_r_2_10, %function
.symver getsgent_r_2_10, getsgent_r@@GLIBC_2.10, remove
getsgent_r_2_10: .quad 0
.balign 8
.globl xdr_unixcred_2_2_5
.type xdr_unixcred_2_2_5, %function
.symver xdr_unixcred_2_2_5, xdr_unixcred@@GLIBC_2.2.5, remove
xdr_unixcred_2_2_5: .quad 0
.balign 8
.globl __strcpy_small_2_2_5
.type __strcpy_small_2_2_5, %function
.symver __strcpy_small_2_2_5, __strcpy_small@@GLIBC_2.2.5, remove
__strcpy_small_2_2_5: .quad 0
.balign 8
.globl wcscasecmp_2_2_5
.type wcscasecmp_2_2_5, %function
.symver wcscasecmp_2_2_5, wcscasecmp@@GLIBC_2.2.5, remove
wcscasecmp_2_2_5: .quad 0
.balign 8
.globl listxattr_2_3
.type listxattr_2_3, %function
.symver listxattr_2_3, listxattr@@GLIBC_2.3, remove
listxattr_2_3: .quad 0
.balign 8
.globl __swprintf_chk_2_4
.type __swprintf_chk_2_4, %function
.symver __swprintf_chk_2_4, __swprintf_chk@@GLIBC_2.4, remove
__swprintf_chk_2_4: .quad 0
.balign 8
.globl inet6_rth_reverse_2_5
.type inet6_rth_reverse_2_5, %function
.symver inet6_rth_reverse_2_5, inet6_rth_reverse@@GLIBC_2.5, remove
inet6_rth_reverse_2_5: .quad 0
.balign 8
.globl lsetxattr_2_3
.type lsetxattr_2_3, %function
.symver lsetxattr_2_3, lsetxattr@@GLIBC_2.3, remove
lsetxattr_2_3: .quad 0
.balign 8
.globl __uflow_2_2_5
.type __uflow_2_2_5, %function
.symver __uflow_2_2_5, __uflow@@GLIBC_2.2.5, remove
__uflow_2_2_5: .quad 0
.balign 8
.globl siggetmask_2_2_5
.type siggetmask_2_2_5, %function
.symver siggetmask_2_2_5, siggetmask@@GLIBC_2.2.5, remove
siggetmask_2_2_5: .quad 0
.balign 8
.globl inet_nsap_addr_2_2_5
.type inet_nsap_addr_2_2_5, %function
.symver inet_nsap_addr_2_2_5, inet_nsap_addr@@GLIBC_2.2.5, remove
inet_nsap_addr_2_2_5: .quad 0
.balign 8
.globl mkostemps_2_11
.type mkostemps_2_11, %function
.symver mkostemps_2_11, mkostemps@@GLIBC_2.11, remove
mkostemps_2_11: .quad 0
.balign 8
.globl __bzero_2_2_5
.type __bzero_2_2_5, %function
.symver __bzero_2_2_5, __bzero@@GLIBC_2.2.5, remove
__bzero_2_2_5: .quad 0
.balign 8
.globl wcstol_l_2_3
.type wcstol_l_2_3, %function
.symver wcstol_l_2_3, wcstol_l@@GLIBC_2.3, remove
wcstol_l_2_3: .quad 0
.balign 8
.globl __strdup_2_2_5
.type __strdup_2_2_5, %function
.symver __strdup_2_2_5, __strdup@@GLIBC_2.2.5, remove
__strdup_2_2_5: .quad 0
.balign 8
.globl strcoll_l_2_3
.type strcoll_l_2_3, %function
.symver strcoll_l_2_3, strcoll_l@@GLIBC_2.3, remove
strcoll_l_2_3: .quad 0
.balign 8
.globl isctype_2_3
.type isctype_2_3, %function
.symver isctype_2_3, isctype@@GLIBC_2.3, remove
isctype_2_3: .quad 0
.balign 8
.globl wcscat_2_2_5
.type wcscat_2_2_5, %function
.symver wcscat_2_2_5, wcscat@@GLIBC_2.2.5, remove
wcscat_2_2_5: .quad 0
.balign 8
.globl waitid_2_2_5
.type waitid_2_2_5, %function
.symver waitid_2_2_5, waitid@@GLIBC_2.2.5, remove
waitid_2_2_5: .quad 0
.balign 8
.globl iscntrl_2_2_5
.type iscntrl_2_2_5, %function
.symver iscntrl_2_2_5, iscntrl@@GLIBC_2.2.5, remove
iscntrl_2_2_5: .quad 0
.balign 8
.globl _IO_wdefault_xsgetn_2_2_5
.type _IO_wdefault_xsgetn_2_2_5, %function
.symver _IO_wdefault_xsgetn_2_2_5, _IO_wdefault_xsgetn@@GLIBC_2.2.5, remove
_IO_wdefault_xsgetn_2_2_5: .quad 0
.balign 8
.globl __wmemmove_chk_2_4
.type __wmemmove_chk_2_4, %function
.symver __wmemmove_chk_2_4, __wmemmove_chk@@GLIBC_2.4, remove
__wmemmove_chk_2_4: .quad 0
.balign 8
.globl ether_ntoa_2_2_5
.type ether_ntoa_2_2_5, %function
.symver ether_ntoa_2_2_5, ether_ntoa@@GLIBC_2.2.5, remove
ether_ntoa_2_2_5: .quad 0
.balign 8
.globl pwritev64_2_10
.type pwritev64_2_10, %function
.symver pwritev64_2_10, pwritev64@@GLIBC_2.10, remove
pwritev64_2_10: .quad 0
.balign 8
.globl sched_get_priority_min_2_2_5
.type sched_get_priority_min_2_2_5, %function
.symver sched_get_priority_min_2_2_5, sched_get_priority_min@@GLIBC_2.2.5, remove
sched_get_priority_min_2_2_5: .quad 0
.balign 8
.globl pause_2_2_5
.type pause_2_2_5, %function
.symver pause_2_2_5, pause@@GLIBC_2.2.5, remove
pause_2_2_5: .quad 0
.balign 8
.globl shmat_2_2_5
.type shmat_2_2_5, %function
.symver shmat_2_2_5, shmat@@GLIBC_2.2.5, remove
shmat_2_2_5: .quad 0
.balign 8
.globl catgets_2_2_5
.type catgets_2_2_5, %function
.symver catgets_2_2_5, catgets@@GLIBC_2.2.5, remove
catgets_2_2_5: .quad 0
.balign 8
.globl _IO_switch_to_get_mode_2_2_5
.type _IO_switch_to_get_mode_2_2_5, %function
.symver _IO_switch_to_get_mode_2_2_5, _IO_switch_to_get_mode@@GLIBC_2.2.5, remove
_IO_switch_to_get_mode_2_2_5: .quad 0
.balign 8
.globl mbrtoc32_2_16
.type mbrtoc32_2_16, %function
.symver mbrtoc32_2_16, mbrtoc32@@GLIBC_2.16, remove
mbrtoc32_2_16: .quad 0
.balign 8
.globl __strpbrk_c3_2_2_5
.type __strpbrk_c3_2_2_5, %function
.symver __strpbrk_c3_2_2_5, __strpbrk_c3@@GLIBC_2.2.5, remove
__strpbrk_c3_2_2_5: .quad 0
.balign 8
.globl _dl_mcount_wrapper_2_2_5
.type _dl_mcount_wrapper_2_2_5, %function
.symver _dl_mcount_wrapper_2_2_5, _dl_mcount_wrapper@@GLIBC_2.2.5, remove
_dl_mcount_wrapper_2_2_5: .quad 0
.balign 8
.globl ntohl_2_2_5
.type ntohl_2_2_5, %function
.symver ntohl_2_2_5, ntohl@@GLIBC_2.2.5, remove
ntohl_2_2_5: .quad 0
.balign 8
.globl memcmp_2_2_5
.type memcmp_2_2_5, %function
.symver memcmp_2_2_5, memcmp@@GLIBC_2.2.5, remove
memcmp_2_2_5: .quad 0
.balign 8
.globl __toascii_l_2_2_5
.type __toascii_l_2_2_5, %function
.symver __toascii_l_2_2_5, __toascii_l@@GLIBC_2.2.5, remove
__toascii_l_2_2_5: .quad 0
.balign 8
.globl wmempcpy_2_2_5
.type wmempcpy_2_2_5, %function
.symver wmempcpy_2_2_5, wmempcpy@@GLIBC_2.2.5, remove
wmempcpy_2_2_5: .quad 0
.balign 8
.globl open64_2_2_5
.type open64_2_2_5, %function
.symver open64_2_2_5, open64@@GLIBC_2.2.5, remove
open64_2_2_5: .quad 0
.balign 8
.globl fchdir_2_2_5
.type fchdir_2_2_5, %function
.symver fchdir_2_2_5, fchdir@@GLIBC_2.2.5, remove
fchdir_2_2_5: .quad 0
.balign 8
.globl fremovexattr_2_3
.type fremovexattr_2_3, %function
.symver fremovexattr_2_3, fremovexattr@@GLIBC_2.3, remove
fremovexattr_2_3: .quad 0
.balign 8
.globl socket_2_2_5
.type socket_2_2_5, %function
.symver socket_2_2_5, socket@@GLIBC_2.2.5, remove
socket_2_2_5: .quad 0
.balign 8
.globl clnt_perrno_2_2_5
.type clnt_perrno_2_2_5, %function
.symver clnt_perrno_2_2_5, clnt_perrno@@GLIBC_2.2.5, remove
clnt_perrno_2_2_5: .quad 0
.balign 8
.globl posix_spawnattr_setsigmask_2_2_5
.type posix_spawnattr_setsigmask_2_2_5, %function
.symver posix_spawnattr_setsigmask_2_2_5, posix_spawnattr_setsigmask@@GLIBC_2.2.5, remove
posix_spawnattr_setsigmask_2_2_5: .quad 0
.balign 8
.globl fnmatch_2_2_5
.type fnmatch_2_2_5, %function
.symver fnmatch_2_2_5, fnmatch@@GLIBC_2.2.5, remove
fnmatch_2_2_5: .quad 0
.balign 8
.globl execvpe_2_11
.type execvpe_2_11, %function
.symver execvpe_2_11, execvpe@@GLIBC_2.11, remove
execvpe_2_11: .quad 0
.balign 8
.globl _IO_file_close_it_2_2_5
.type _IO_file_close_it_2_2_5, %function
.symver _IO_file_close_it_2_2_5, _IO_file_close_it@@GLIBC_2.2.5, remove
_IO_file_close_it_2_2_5: .quad 0
.balign 8
.globl _IO_default_xsputn_2_2_5
.type _IO_default_xsputn_2_2_5, %function
.symver _IO_default_xsputn_2_2_5, _IO_default_xsputn@@GLIBC_2.2.5, remove
_IO_default_xsputn_2_2_5: .quad 0
.balign 8
.globl svcudp_create_2_2_5
.type svcudp_create_2_2_5, %function
.symver svcudp_create_2_2_5, svcudp_create@@GLIBC_2.2.5, remove
svcudp_create_2_2_5: .quad 0
.balign 8
.globl freeaddrinfo_2_2_5
.type freeaddrinfo_2_2_5, %function
.symver freeaddrinfo_2_2_5, freeaddrinfo@@GLIBC_2.2.5, remove
freeaddrinfo_2_2_5: .quad 0
.balign 8
.globl __obstack_printf_chk_2_8
.type __obstack_printf_chk_2_8, %function
.symver __obstack_printf_chk_2_8, __obstack_printf_chk@@GLIBC_2.8, remove
__obstack_printf_chk_2_8: .quad 0
.balign 8
.globl __iswctype_2_2_5
.type __iswctype_2_2_5, %function
.symver __iswctype_2_2_5, __iswctype@@GLIBC_2.2.5, remove
__iswctype_2_2_5: .quad 0
.balign 8
.globl __sigpause_2_2_5
.type __sigpause_2_2_5, %function
.symver __sigpause_2_2_5, __sigpause@@GLIBC_2.2.5, remove
__sigpause_2_2_5: .quad 0
.balign 8
.globl ntp_adjtime_2_2_5
.type ntp_adjtime_2_2_5, %function
.symver ntp_adjtime_2_2_5, ntp_adjtime@@GLIBC_2.2.5, remove
ntp_adjtime_2_2_5: .quad 0
.balign 8
.globl putmsg_2_2_5
.type putmsg_2_2_5, %function
.symver putmsg_2_2_5, putmsg@@GLIBC_2.2.5, remove
putmsg_2_2_5: .quad 0
.balign 8
.globl funlockfile_2_2_5
.type funlockfile_2_2_5, %function
.symver funlockfile_2_2_5, funlockfile@@GLIBC_2.2.5, remove
funlockfile_2_2_5: .quad 0
.balign 8
.globl _IO_wfile_seekoff_2_2_5
.type _IO_wfile_seekoff_2_2_5, %function
.symver _IO_wfile_seekoff_2_2_5, _IO_wfile_seekoff@@GLIBC_2.2.5, remove
_IO_wfile_seekoff_2_2_5: .quad 0
.balign 8
.globl fattach_2_2_5
.type fattach_2_2_5, %function
.symver fattach_2_2_5, fattach@@GLIBC_2.2.5, remove
fattach_2_2_5: .quad 0
.balign 8
.globl _IO_putc_2_2_5
.type _IO_putc_2_2_5, %function
.symver _IO_putc_2_2_5, _IO_putc@@GLIBC_2.2.5, remove
_IO_putc_2_2_5: .quad 0
.balign 8
.globl fgetpwent_2_2_5
.type fgetpwent_2_2_5, %function
.symver fgetpwent_2_2_5, fgetpwent@@GLIBC_2.2.5, remove
fgetpwent_2_2_5: .quad 0
.balign 8
.globl __pwrite64_2_2_5
.type __pwrite64_2_2_5, %function
.symver __pwrite64_2_2_5, __pwrite64@@GLIBC_2.2.5, remove
__pwrite64_2_2_5: .quad 0
.balign 8
.globl utimes_2_2_5
.type utimes_2_2_5, %function
.symver utimes_2_2_5, utimes@@GLIBC_2.2.5, remove
utimes_2_2_5: .quad 0
.balign 8
.globl endmntent_2_2_5
.type endmntent_2_2_5, %function
.symver endmntent_2_2_5, endmntent@@GLIBC_2.2.5, remove
endmntent_2_2_5: .quad 0
.balign 8
.globl __strsep_1c_2_2_5
.type __strsep_1c_2_2_5, %function
.symver __strsep_1c_2_2_5, __strsep_1c@@GLIBC_2.2.5, remove
__strsep_1c_2_2_5: .quad 0
.balign 8
.globl __wcsncat_chk_2_4
.type __wcsncat_chk_2_4, %function
.symver __wcsncat_chk_2_4, __wcsncat_chk@@GLIBC_2.4, remove
__wcsncat_chk_2_4: .quad 0
.balign 8
.globl xdr_string_2_2_5
.type xdr_string_2_2_5, %function
.symver xdr_string_2_2_5, xdr_string@@GLIBC_2.2.5, remove
xdr_string_2_2_5: .quad 0
.balign 8
.globl __rpc_thread_svc_max_pollfd_2_2_5
.type __rpc_thread_svc_max_pollfd_2_2_5, %function
.symver __rpc_thread_svc_max_pollfd_2_2_5, __rpc_thread_svc_max_pollfd@@GLIBC_2.2.5, remove
__rpc_thread_svc_max_pollfd_2_2_5: .quad 0
.balign 8
.globl __signbitl_2_2_5
.type __signbitl_2_2_5, %function
.symver __signbitl_2_2_5, __signbitl@@GLIBC_2.2.5, remove
__signbitl_2_2_5: .quad 0
.balign 8
.globl ssignal_2_2_5
.type ssignal_2_2_5, %function
.symver ssignal_2_2_5, ssignal@@GLIBC_2.2.5, remove
ssignal_2_2_5: .quad 0
.balign 8
.globl inet_aton_2_2_5
.type inet_aton_2_2_5, %function
.symver inet_aton_2_2_5, inet_aton@@GLIBC_2.2.5, remove
inet_aton_2_2_5: .quad 0
.balign 8
.globl __ctype_b_loc_2_3
.type __ctype_b_loc_2_3, %function
.symver __ctype_b_loc_2_3, __ctype_b_loc@@GLIBC_2.3, remove
__ctype_b_loc_2_3: .quad 0
.balign 8
.globl clnt_pcreateerror_2_2_5
.type clnt_pcreateerror_2_2_5, %function
.symver clnt_pcreateerror_2_2_5, clnt_pcreateerror@@GLIBC_2.2.5, remove
clnt_pcreateerror_2_2_5: .quad 0
.balign 8
.globl strtold_l_2_3
.type strtold_l_2_3, %function
.symver strtold_l_2_3, strtold_l@@GLIBC_2.3, remove
strtold_l_2_3: .quad 0
.balign 8
.globl innetgr_2_2_5
.type innetgr_2_2_5, %function
.symver innetgr_2_2_5, innetgr@@GLIBC_2.2.5, remove
innetgr_2_2_5: .quad 0
.balign 8
.globl _IO_iter_next_2_2_5
.type _IO_iter_next_2_2_5, %function
.symver _IO_iter_next_2_2_5, _IO_iter_next@@GLIBC_2.2.5, remove
_IO_iter_next_2_2_5: .quad 0
.balign 8
.globl setaliasent_2_2_5
.type setaliasent_2_2_5, %function
.symver setaliasent_2_2_5, setaliasent@@GLIBC_2.2.5, remove
setaliasent_2_2_5: .quad 0
.balign 8
.globl get_nprocs_2_2_5
.type get_nprocs_2_2_5, %function
.symver get_nprocs_2_2_5, get_nprocs@@GLIBC_2.2.5, remove
get_nprocs_2_2_5: .quad 0
.balign 8
.globl gnu_dev_major_2_3_3
.type gnu_dev_major_2_3_3, %function
.symver gnu_dev_major_2_3_3, gnu_dev_major@@GLIBC_2.3.3, remove
gnu_dev_major_2_3_3: .quad 0
.balign 8
.globl lldiv_2_2_5
.type lldiv_2_2_5, %function
.symver lldiv_2_2_5, lldiv@@GLIBC_2.2.5, remove
lldiv_2_2_5: .quad 0
.balign 8
.globl asctime_2_2_5
.type asctime_2_2_5, %function
.symver asctime_2_2_5, asctime@@GLIBC_2.2.5, remove
asctime_2_2_5: .quad 0
.balign 8
.globl _tolower_2_2_5
.type _tolower_2_2_5, %function
.symver _tolower_2_2_5, _tolower@@GLIBC_2.2.5, remove
_tolower_2_2_5: .quad 0
.balign 8
.globl __assert_perror_fail_2_2_5
.type __assert_perror_fail_2_2_5, %function
.symver __assert_perror_fail_2_2_5, __assert_perror_fail@@GLIBC_2.2.5, remove
__assert_perror_fail_2_2_5: .quad 0
.balign 8
.globl getaliasbyname_2_2_5
.type getaliasbyname_2_2_5, %function
.symver getaliasbyname_2_2_5, getaliasbyname@@GLIBC_2.2.5, remove
getaliasbyname_2_2_5: .quad 0
.balign 8
.globl printf_size_2_2_5
.type printf_size_2_2_5, %function
.symver printf_size_2_2_5, printf_size@@GLIBC_2.2.5, remove
printf_size_2_2_5: .quad 0
.balign 8
.globl __wctomb_chk_2_4
.type __wctomb_chk_2_4, %function
.symver __wctomb_chk_2_4, __wctomb_chk@@GLIBC_2.4, remove
__wctomb_chk_2_4: .quad 0
.balign 8
.globl __fwprintf_chk_2_4
.type __fwprintf_chk_2_4, %function
.symver __fwprintf_chk_2_4, __fwprintf_chk@@GLIBC_2.4, remove
__fwprintf_chk_2_4: .quad 0
.balign 8
.globl arch_prctl_2_2_5
.type arch_prctl_2_2_5, %function
.symver arch_prctl_2_2_5, arch_prctl@@GLIBC_2.2.5, remove
arch_prctl_2_2_5: .quad 0
.balign 8
.globl fopencookie_2_2_5
.type fopencookie_2_2_5, %function
.symver fopencookie_2_2_5, fopencookie@@GLIBC_2.2.5, remove
fopencookie_2_2_5: .quad 0
.balign 8
.globl getservbyport_2_2_5
.type getservbyport_2_2_5, %function
.symver getservbyport_2_2_5, getservbyport@@GLIBC_2.2.5, remove
getservbyport_2_2_5: .quad 0
.balign 8
.globl pthread_setschedparam_2_2_5
.type pthread_setschedparam_2_2_5, %function
.symver pthread_setschedparam_2_2_5, pthread_setschedparam@@GLIBC_2.2.5, remove
pthread_setschedparam_2_2_5: .quad 0
.balign 8
.globl setttyent_2_2_5
.type setttyent_2_2_5, %function
.symver setttyent_2_2_5, setttyent@@GLIBC_2.2.5, remove
setttyent_2_2_5: .quad 0
.balign 8
.globl regexec_2_2_5
.type regexec_2_2_5, %function
.symver regexec_2_2_5, regexec@GLIBC_2.2.5, remove
regexec_2_2_5: .quad 0
.balign 8
.globl regexec_2_3_4
.type regexec_2_3_4, %function
.symver regexec_2_3_4, regexec@@GLIBC_2.3.4, remove
regexec_2_3_4: .quad 0
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
.globl __fwritable_2_2_5
.type __fwritable_2_2_5, %function
.symver __fwritable_2_2_5, __fwritable@@GLIBC_2.2.5, remove
__fwritable_2_2_5: .quad 0
.balign 8
.globl clock_nanosleep_2_17
.type clock_nanosleep_2_17, %function
.symver clock_nanosleep_2_17, clock_nanosleep@@GLIBC_2.17, remove
clock_nanosleep_2_17: .quad 0
.balign 8
.globl fopen64_2_2_5
.type fopen64_2_2_5, %function
.symver fopen64_2_2_5, fopen64@@GLIBC_2.2.5, remove
fopen64_2_2_5: .quad 0
.balign 8
.globl __vsprintf_chk_2_3_4
.type __vsprintf_chk_2_3_4, %function
.symver __vsprintf_chk_2_3_4, __vsprintf_chk@@GLIBC_2.3.4, remove
__vsprintf_chk_2_3_4: .quad 0
.balign 8
.globl inet6_opt_append_2_5
.type inet6_opt_append_2_5, %function
.symver inet6_opt_append_2_5, inet6_opt_append@@GLIBC_2.5, remove
inet6_opt_append_2_5: .quad 0
.balign 8
.globl wcsrtombs_2_2_5
.type wcsrtombs_2_2_5, %function
.symver wcsrtombs_2_2_5, wcsrtombs@@GLIBC_2.2.5, remove
wcsrtombs_2_2_5: .quad 0
.balign 8
.globl backtrace_symbols_2_2_5
.type backtrace_symbols_2_2_5, %function
.symver backtrace_symbols_2_2_5, backtrace_symbols@@GLIBC_2.2.5, remove
backtrace_symbols_2_2_5: .quad 0
.balign 8
.globl fts_open_2_2_5
.type fts_open_2_2_5, %function
.symver fts_open_2_2_5, fts_open@@GLIBC_2.2.5, remove
fts_open_2_2_5: .quad 0
.balign 8
.globl fputws_unlocked_2_2_5
.type fputws_unlocked_2_2_5, %function
.symver fputws_unlocked_2_2_5, fputws_unlocked@@GLIBC_2.2.5, remove
fputws_unlocked_2_2_5: .quad 0
.balign 8
.globl acct_2_2_5
.type acct_2_2_5, %function
.symver acct_2_2_5, acct@@GLIBC_2.2.5, remove
acct_2_2_5: .quad 0
.balign 8
.globl getegid_2_2_5
.type getegid_2_2_5, %function
.symver getegid_2_2_5, getegid@@GLIBC_2.2.5, remove
getegid_2_2_5: .quad 0
.balign 8
.globl __open_2_2_5
.type __open_2_2_5, %function
.symver __open_2_2_5, __open@@GLIBC_2.2.5, remove
__open_2_2_5: .quad 0
.balign 8
.globl __wcstoull_l_2_2_5
.type __wcstoull_l_2_2_5, %function
.symver __wcstoull_l_2_2_5, __wcstoull_l@@GLIBC_2.2.5, remove
__wcstoull_l_2_2_5: .quad 0
.balign 8
.globl envz_entry_2_2_5
.type envz_entry_2_2_5, %function
.symver envz_entry_2_2_5, envz_entry@@GLIBC_2.2.5, remove
envz_entry_2_2_5: .quad 0
.balign 8
.globl xdr_char_2_2_5
.type xdr_char_2_2_5, %function
.symver xdr_char_2_2_5, xdr_char@@GLIBC_2.2.5, remove
xdr_char_2_2_5: .quad 0
.balign 8
.globl isastream_2_2_5
.type isastream_2_2_5, %function
.symver isastream_2_2_5, isastream@@GLIBC_2.2.5, remove
isastream_2_2_5: .quad 0
.balign 8
.globl iswalpha_2_2_5
.type iswalpha_2_2_5, %function
.symver iswalpha_2_2_5, iswalpha@@GLIBC_2.2.5, remove
iswalpha_2_2_5: .quad 0
.balign 8
.globl getopt_long_2_2_5
.type getopt_long_2_2_5, %function
.symver getopt_long_2_2_5, getopt_long@@GLIBC_2.2.5, remove
getopt_long_2_2_5: .quad 0
.balign 8
.globl tcgetattr_2_2_5
.type tcgetattr_2_2_5, %function
.symver tcgetattr_2_2_5, tcgetattr@@GLIBC_2.2.5, remove
tcgetattr_2_2_5: .quad 0
.balign 8
.globl dirfd_2_2_5
.type dirfd_2_2_5, %function
.symver dirfd_2_2_5, dirfd@@GLIBC_2.2.5, remove
dirfd_2_2_5: .quad 0
.balign 8
.globl syncfs_2_14
.type syncfs_2_14, %function
.symver syncfs_2_14, syncfs@@GLIBC_2.14, remove
syncfs_2_14: .quad 0
.balign 8
.globl xdr_netobj_2_2_5
.type xdr_netobj_2_2_5, %function
.symver xdr_netobj_2_2_5, xdr_netobj@@GLIBC_2.2.5, remove
xdr_netobj_2_2_5: .quad 0
.balign 8
.globl ispunct_2_2_5
.type ispunct_2_2_5, %function
.symver ispunct_2_2_5, ispunct@@GLIBC_2.2.5, remove
ispunct_2_2_5: .quad 0
.balign 8
.globl isalnum_2_2_5
.type isalnum_2_2_5, %function
.symver isalnum_2_2_5, isalnum@@GLIBC_2.2.5, remove
isalnum_2_2_5: .quad 0
.balign 8
.globl fgetsgent_2_10
.type fgetsgent_2_10, %function
.symver fgetsgent_2_10, fgetsgent@@GLIBC_2.10, remove
fgetsgent_2_10: .quad 0
.balign 8
.globl lrand48_2_2_5
.type lrand48_2_2_5, %function
.symver lrand48_2_2_5, lrand48@@GLIBC_2.2.5, remove
lrand48_2_2_5: .quad 0
.balign 8
.globl inet_nsap_ntoa_2_2_5
.type inet_nsap_ntoa_2_2_5, %function
.symver inet_nsap_ntoa_2_2_5, inet_nsap_ntoa@@GLIBC_2.2.5, remove
inet_nsap_ntoa_2_2_5: .quad 0
.balign 8
.globl puts_2_2_5
.type puts_2_2_5, %function
.symver puts_2_2_5, puts@@GLIBC_2.2.5, remove
puts_2_2_5: .quad 0
.balign 8
.globl on_exit_2_2_5
.type on_exit_2_2_5, %function
.symver on_exit_2_2_5, on_exit@@GLIBC_2.2.5, remove
on_exit_2_2_5: .quad 0
.balign 8
.globl iswpunct_2_2_5
.type iswpunct_2_2_5, %function
.symver iswpunct_2_2_5, iswpunct@@GLIBC_2.2.5, remove
iswpunct_2_2_5: .quad 0
.balign 8
.globl posix_spawnattr_init_2_2_5
.type posix_spawnattr_init_2_2_5, %function
.symver posix_spawnattr_init_2_2_5, posix_spawnattr_init@@GLIBC_2.2.5, remove
posix_spawnattr_init_2_2_5: .quad 0
.balign 8
.globl __fprintf_chk_2_3_4
.type __fprintf_chk_2_3_4, %function
.symver __fprintf_chk_2_3_4, __fprintf_chk@@GLIBC_2.3.4, remove
__fprintf_chk_2_3_4: .quad 0
.balign 8
.globl xdr_union_2_2_5
.type xdr_union_2_2_5, %function
.symver xdr_union_2_2_5, xdr_union@@GLIBC_2.2.5, remove
xdr_union_2_2_5: .quad 0
.balign 8
.globl modify_ldt_2_2_5
.type modify_ldt_2_2_5, %function
.symver modify_ldt_2_2_5, modify_ldt@@GLIBC_2.2.5, remove
modify_ldt_2_2_5: .quad 0
.balign 8
.globl __xstat64_2_2_5
.type __xstat64_2_2_5, %function
.symver __xstat64_2_2_5, __xstat64@@GLIBC_2.2.5, remove
__xstat64_2_2_5: .quad 0
.balign 8
.globl linkat_2_4
.type linkat_2_4, %function
.symver linkat_2_4, linkat@@GLIBC_2.4, remove
linkat_2_4: .quad 0
.balign 8
.globl fchmodat_2_4
.type fchmodat_2_4, %function
.symver fchmodat_2_4, fchmodat@@GLIBC_2.4, remove
fchmodat_2_4: .quad 0
.balign 8
.globl strlen_2_2_5
.type strlen_2_2_5, %function
.symver strlen_2_2_5, strlen@@GLIBC_2.2.5, remove
strlen_2_2_5: .quad 0
.balign 8
.globl utimensat_2_6
.type utimensat_2_6, %function
.symver utimensat_2_6, utimensat@@GLIBC_2.6, remove
utimensat_2_6: .quad 0
.balign 8
.globl xdrrec_endofrecord_2_2_5
.type xdrrec_endofrecord_2_2_5, %function
.symver xdrrec_endofrecord_2_2_5, xdrrec_endofrecord@@GLIBC_2.2.5, remove
xdrrec_endofrecord_2_2_5: .quad 0
.balign 8
.globl pthread_exit_2_2_5
.type pthread_exit_2_2_5, %function
.symver pthread_exit_2_2_5, pthread_exit@@GLIBC_2.2.5, remove
pthread_exit_2_2_5: .quad 0
.balign 8
.globl rcmd_2_2_5
.type rcmd_2_2_5, %function
.symver rcmd_2_2_5, rcmd@@GLIBC_2.2.5, remove
rcmd_2_2_5: .quad 0
.balign 8
.globl xdr_accepted_reply_2_2_5
.type xdr_accepted_reply_2_2_5, %function
.symver xdr_accepted_reply_2_2_5, xdr_accepted_reply@@GLIBC_2.2.5, remove
xdr_accepted_reply_2_2_5: .quad 0
.balign 8
.globl pthread_setcanceltype_2_2_5
.type pthread_setcanceltype_2_2_5, %function
.symver pthread_setcanceltype_2_2_5, pthread_setcanceltype@@GLIBC_2.2.5, remove
pthread_setcanceltype_2_2_5: .quad 0
.balign 8
.globl fcvt_r_2_2_5
.type fcvt_r_2_2_5, %function
.symver fcvt_r_2_2_5, fcvt_r@@GLIBC_2.2.5, remove
fcvt_r_2_2_5: .quad 0
.balign 8
.globl _IO_fwrite_2_2_5
.type _IO_fwrite_2_2_5, %function
.symver _IO_fwrite_2_2_5, _IO_fwrite@@GLIBC_2.2.5, remove
_IO_fwrite_2_2_5: .quad 0
.balign 8
.globl rewind_2_2_5
.type rewind_2_2_5, %function
.symver rewind_2_2_5, rewind@@GLIBC_2.2.5, remove
rewind_2_2_5: .quad 0
.balign 8
.globl xdr_u_long_2_2_5
.type xdr_u_long_2_2_5, %function
.symver xdr_u_long_2_2_5, xdr_u_long@@GLIBC_2.2.5, remove
xdr_u_long_2_2_5: .quad 0
.balign 8
.globl xdr_bytes_2_2_5
.type xdr_bytes_2_2_5, %function
.symver xdr_bytes_2_2_5, xdr_bytes@@GLIBC_2.2.5, remove
xdr_bytes_2_2_5: .quad 0
.balign 8
.globl xdr_hyper_2_2_5
.type xdr_hyper_2_2_5, %function
.symver xdr_hyper_2_2_5, xdr_hyper@@GLIBC_2.2.5, remove
xdr_hyper_2_2_5: .quad 0
.balign 8
.globl _IO_marker_difference_2_2_5
.type _IO_marker_difference_2_2_5, %function
.symver _IO_marker_difference_2_2_5, _IO_marker_difference@@GLIBC_2.2.5, remove
_IO_marker_difference_2_2_5: .quad 0
.balign 8
.globl getspnam_2_2_5
.type getspnam_2_2_5, %function
.symver getspnam_2_2_5, getspnam@@GLIBC_2.2.5, remove
getspnam_2_2_5: .quad 0
.balign 8
.globl xdr_rmtcallres_2_2_5
.type xdr_rmtcallres_2_2_5, %function
.symver xdr_rmtcallres_2_2_5, xdr_rmtcallres@@GLIBC_2.2.5, remove
xdr_rmtcallres_2_2_5: .quad 0
.balign 8
.globl xdrrec_create_2_2_5
.type xdrrec_create_2_2_5, %function
.symver xdrrec_create_2_2_5, xdrrec_create@@GLIBC_2.2.5, remove
xdrrec_create_2_2_5: .quad 0
.balign 8
.globl _authenticate_2_2_5
.type _authenticate_2_2_5, %function
.symver _authenticate_2_2_5, _authenticate@@GLIBC_2.2.5, remove
_authenticate_2_2_5: .quad 0
.balign 8
.globl getpgrp_2_2_5
.type getpgrp_2_2_5, %function
.symver getpgrp_2_2_5, getpgrp@@GLIBC_2.2.5, remove
getpgrp_2_2_5: .quad 0
.balign 8
.globl fallocate64_2_10
.type fallocate64_2_10, %function
.symver fallocate64_2_10, fallocate64@@GLIBC_2.10, remove
fallocate64_2_10: .quad 0
.balign 8
.globl iswgraph_2_2_5
.type iswgraph_2_2_5, %function
.symver iswgraph_2_2_5, iswgraph@@GLIBC_2.2.5, remove
iswgraph_2_2_5: .quad 0
.balign 8
.globl sbrk_2_2_5
.type sbrk_2_2_5, %function
.symver sbrk_2_2_5, sbrk@@GLIBC_2.2.5, remove
sbrk_2_2_5: .quad 0
.balign 8
.globl grantpt_2_2_5
.type grantpt_2_2_5, %function
.symver grantpt_2_2_5, grantpt@@GLIBC_2.2.5, remove
grantpt_2_2_5: .quad 0
.balign 8
.globl ftw_2_2_5
.type ftw_2_2_5, %function
.symver ftw_2_2_5, ftw@@GLIBC_2.2.5, remove
ftw_2_2_5: .quad 0
.balign 8
.globl glob_2_2_5
.type glob_2_2_5, %function
.symver glob_2_2_5, glob@@GLIBC_2.2.5, remove
glob_2_2_5: .quad 0
.balign 8
.globl inet6_option_alloc_2_3_3
.type inet6_option_alloc_2_3_3, %function
.symver inet6_option_alloc_2_3_3, inet6_option_alloc@@GLIBC_2.3.3, remove
inet6_option_alloc_2_3_3: .quad 0
.balign 8
.globl gethostent_2_2_5
.type gethostent_2_2_5, %function
.symver gethostent_2_2_5, gethostent@@GLIBC_2.2.5, remove
gethostent_2_2_5: .quad 0
.balign 8
.globl __strspn_c2_2_2_5
.type __strspn_c2_2_2_5, %function
.symver __strspn_c2_2_2_5, __strspn_c2@@GLIBC_2.2.5, remove
__strspn_c2_2_2_5: .quad 0
.balign 8
.globl snprintf_2_2_5
.type snprintf_2_2_5, %function
.symver snprintf_2_2_5, snprintf@@GLIBC_2.2.5, remove
snprintf_2_2_5: .quad 0
.balign 8
.globl glob_pattern_p_2_2_5
.type glob_pattern_p_2_2_5, %function
.symver glob_pattern_p_2_2_5, glob_pattern_p@@GLIBC_2.2.5, remove
glob_pattern_p_2_2_5: .quad 0
.balign 8
.globl __strverscmp_2_2_5
.type __strverscmp_2_2_5, %function
.symver __strverscmp_2_2_5, __strverscmp@@GLIBC_2.2.5, remove
__strverscmp_2_2_5: .quad 0
.balign 8
.globl umount2_2_2_5
.type umount2_2_2_5, %function
.symver umount2_2_2_5, umount2@@GLIBC_2.2.5, remove
umount2_2_2_5: .quad 0
.balign 8
.globl inet_makeaddr_2_2_5
.type inet_makeaddr_2_2_5, %function
.symver inet_makeaddr_2_2_5, inet_makeaddr@@GLIBC_2.2.5, remove
inet_makeaddr_2_2_5: .quad 0
.balign 8
.globl _rpc_dtablesize_2_2_5
.type _rpc_dtablesize_2_2_5, %function
.symver _rpc_dtablesize_2_2_5, _rpc_dtablesize@@GLIBC_2.2.5, remove
_rpc_dtablesize_2_2_5: .quad 0
.balign 8
.globl re_set_registers_2_2_5
.type re_set_registers_2_2_5, %function
.symver re_set_registers_2_2_5, re_set_registers@@GLIBC_2.2.5, remove
re_set_registers_2_2_5: .quad 0
.balign 8
.globl iruserok_af_2_2_5
.type iruserok_af_2_2_5, %function
.symver iruserok_af_2_2_5, iruserok_af@@GLIBC_2.2.5, remove
iruserok_af_2_2_5: .quad 0
.balign 8
.globl __towctrans_l_2_2_5
.type __towctrans_l_2_2_5, %function
.symver __towctrans_l_2_2_5, __towctrans_l@@GLIBC_2.2.5, remove
__towctrans_l_2_2_5: .quad 0
.balign 8
.globl jrand48_r_2_2_5
.type jrand48_r_2_2_5, %function
.symver jrand48_r_2_2_5, jrand48_r@@GLIBC_2.2.5, remove
jrand48_r_2_2_5: .quad 0
.balign 8
.globl obstack_printf_2_2_5
.type obstack_printf_2_2_5, %function
.symver obstack_printf_2_2_5, obstack_printf@@GLIBC_2.2.5, remove
obstack_printf_2_2_5: .quad 0
.balign 8
.globl erand48_2_2_5
.type erand48_2_2_5, %function
.symver erand48_2_2_5, erand48@@GLIBC_2.2.5, remove
erand48_2_2_5: .quad 0
.balign 8
.globl putspent_2_2_5
.type putspent_2_2_5, %function
.symver putspent_2_2_5, putspent@@GLIBC_2.2.5, remove
putspent_2_2_5: .quad 0
.balign 8
.globl gmtime_r_2_2_5
.type gmtime_r_2_2_5, %function
.symver gmtime_r_2_2_5, gmtime_r@@GLIBC_2.2.5, remove
gmtime_r_2_2_5: .quad 0
.balign 8
.globl __strtol_internal_2_2_5
.type __strtol_internal_2_2_5, %function
.symver __strtol_internal_2_2_5, __strtol_internal@@GLIBC_2.2.5, remove
__strtol_internal_2_2_5: .quad 0
.balign 8
.globl _IO_seekwmark_2_2_5
.type _IO_seekwmark_2_2_5, %function
.symver _IO_seekwmark_2_2_5, _IO_seekwmark@@GLIBC_2.2.5, remove
_IO_seekwmark_2_2_5: .quad 0
.balign 8
.globl _IO_wdefault_uflow_2_2_5
.type _IO_wdefault_uflow_2_2_5, %function
.symver _IO_wdefault_uflow_2_2_5, _IO_wdefault_uflow@@GLIBC_2.2.5, remove
_IO_wdefault_uflow_2_2_5: .quad 0
.balign 8
.globl clnt_sperrno_2_2_5
.type clnt_sperrno_2_2_5, %function
.symver clnt_sperrno_2_2_5, clnt_sperrno@@GLIBC_2.2.5, remove
clnt_sperrno_2_2_5: .quad 0
.balign 8
.globl _IO_getline_info_2_2_5
.type _IO_getline_info_2_2_5, %function
.symver _IO_getline_info_2_2_5, _IO_getline_info@@GLIBC_2.2.5, remove
_IO_getline_info_2_2_5: .quad 0
.balign 8
.globl svcfd_create_2_2_5
.type svcfd_create_2_2_5, %function
.symver svcfd_create_2_2_5, svcfd_create@@GLIBC_2.2.5, remove
svcfd_create_2_2_5: .quad 0
.balign 8
.globl __overflow_2_2_5
.type __overflow_2_2_5, %function
.symver __overflow_2_2_5, __overflow@@GLIBC_2.2.5, remove
__overflow_2_2_5: .quad 0
.balign 8
.globl strcspn_2_2_5
.type strcspn_2_2_5, %function
.symver strcspn_2_2_5, strcspn@@GLIBC_2.2.5, remove
strcspn_2_2_5: .quad 0
.balign 8
.globl dup3_2_9
.type dup3_2_9, %function
.symver dup3_2_9, dup3@@GLIBC_2.9, remove
dup3_2_9: .quad 0
.balign 8
.globl ruserok_af_2_2_5
.type ruserok_af_2_2_5, %function
.symver ruserok_af_2_2_5, ruserok_af@@GLIBC_2.2.5, remove
ruserok_af_2_2_5: .quad 0
.balign 8
.globl rresvport_af_2_2_5
.type rresvport_af_2_2_5, %function
.symver rresvport_af_2_2_5, rresvport_af@@GLIBC_2.2.5, remove
rresvport_af_2_2_5: .quad 0
.balign 8
.globl modf_2_2_5
.type modf_2_2_5, %function
.symver modf_2_2_5, modf@@GLIBC_2.2.5, remove
modf_2_2_5: .quad 0
.balign 8
.globl getaliasent_2_2_5
.type getaliasent_2_2_5, %function
.symver getaliasent_2_2_5, getaliasent@@GLIBC_2.2.5, remove
getaliasent_2_2_5: .quad 0
.balign 8
.globl __wcsncasecmp_l_2_2_5
.type __wcsncasecmp_l_2_2_5, %function
.symver __wcsncasecmp_l_2_2_5, __wcsncasecmp_l@@GLIBC_2.2.5, remove
__wcsncasecmp_l_2_2_5: .quad 0
.balign 8
.globl strncasecmp_2_2_5
.type strncasecmp_2_2_5, %function
.symver strncasecmp_2_2_5, strncasecmp@@GLIBC_2.2.5, remove
strncasecmp_2_2_5: .quad 0
.balign 8
.globl raise_2_2_5
.type raise_2_2_5, %function
.symver raise_2_2_5, raise@@GLIBC_2.2.5, remove
raise_2_2_5: .quad 0
.balign 8
.globl fsetpos_2_2_5
.type fsetpos_2_2_5, %function
.symver fsetpos_2_2_5, fsetpos@@GLIBC_2.2.5, remove
fsetpos_2_2_5: .quad 0
.balign 8
.globl dysize_2_2_5
.type dysize_2_2_5, %function
.symver dysize_2_2_5, dysize@@GLIBC_2.2.5, remove
dysize_2_2_5: .quad 0
.balign 8
.globl vsyslog_2_2_5
.type vsyslog_2_2_5, %function
.symver vsyslog_2_2_5, vsyslog@@GLIBC_2.2.5, remove
vsyslog_2_2_5: .quad 0
.balign 8
.globl xdr_bool_2_2_5
.type xdr_bool_2_2_5, %function
.symver xdr_bool_2_2_5, xdr_bool@@GLIBC_2.2.5, remove
xdr_bool_2_2_5: .quad 0
.balign 8
.globl clnt_create_2_2_5
.type clnt_create_2_2_5, %function
.symver clnt_create_2_2_5, clnt_create@@GLIBC_2.2.5, remove
clnt_create_2_2_5: .quad 0
.balign 8
.globl feof_2_2_5
.type feof_2_2_5, %function
.symver feof_2_2_5, feof@@GLIBC_2.2.5, remove
feof_2_2_5: .quad 0
.balign 8
.globl iopl_2_2_5
.type iopl_2_2_5, %function
.symver iopl_2_2_5, iopl@@GLIBC_2.2.5, remove
iopl_2_2_5: .quad 0
.balign 8
.globl mkstemps_2_11
.type mkstemps_2_11, %function
.symver mkstemps_2_11, mkstemps@@GLIBC_2.11, remove
mkstemps_2_11: .quad 0
.balign 8
.globl sigtimedwait_2_2_5
.type sigtimedwait_2_2_5, %function
.symver sigtimedwait_2_2_5, sigtimedwait@@GLIBC_2.2.5, remove
sigtimedwait_2_2_5: .quad 0
.balign 8
.globl free_2_2_5
.type free_2_2_5, %function
.symver free_2_2_5, free@@GLIBC_2.2.5, remove
free_2_2_5: .quad 0
.balign 8
.globl fseek_2_2_5
.type fseek_2_2_5, %function
.symver fseek_2_2_5, fseek@@GLIBC_2.2.5, remove
fseek_2_2_5: .quad 0
.balign 8
.globl memrchr_2_2_5
.type memrchr_2_2_5, %function
.symver memrchr_2_2_5, memrchr@@GLIBC_2.2.5, remove
memrchr_2_2_5: .quad 0
.balign 8
.globl strtod_2_2_5
.type strtod_2_2_5, %function
.symver strtod_2_2_5, strtod@@GLIBC_2.2.5, remove
strtod_2_2_5: .quad 0
.balign 8
.globl __wcsrtombs_chk_2_4
.type __wcsrtombs_chk_2_4, %function
.symver __wcsrtombs_chk_2_4, __wcsrtombs_chk@@GLIBC_2.4, remove
__wcsrtombs_chk_2_4: .quad 0
.balign 8
.globl __getgroups_chk_2_4
.type __getgroups_chk_2_4, %function
.symver __getgroups_chk_2_4, __getgroups_chk@@GLIBC_2.4, remove
__getgroups_chk_2_4: .quad 0
.balign 8
.globl __vfscanf_2_2_5
.type __vfscanf_2_2_5, %function
.symver __vfscanf_2_2_5, __vfscanf@@GLIBC_2.2.5, remove
__vfscanf_2_2_5: .quad 0
.balign 8
.globl _IO_iter_file_2_2_5
.type _IO_iter_file_2_2_5, %function
.symver _IO_iter_file_2_2_5, _IO_iter_file@@GLIBC_2.2.5, remove
_IO_iter_file_2_2_5: .quad 0
.balign 8
.globl strdup_2_2_5
.type strdup_2_2_5, %function
.symver strdup_2_2_5, strdup@@GLIBC_2.2.5, remove
strdup_2_2_5: .quad 0
.balign 8
.globl nftw_2_2_5
.type nftw_2_2_5, %function
.symver nftw_2_2_5, nftw@GLIBC_2.2.5, remove
nftw_2_2_5: .quad 0
.balign 8
.globl nftw_2_3_3
.type nftw_2_3_3, %function
.symver nftw_2_3_3, nftw@@GLIBC_2.3.3, remove
nftw_2_3_3: .quad 0
.balign 8
.globl getsockname_2_2_5
.type getsockname_2_2_5, %function
.symver getsockname_2_2_5, getsockname@@GLIBC_2.2.5, remove
getsockname_2_2_5: .quad 0
.balign 8
.globl getutmpx_2_2_5
.type getutmpx_2_2_5, %function
.symver getutmpx_2_2_5, getutmpx@@GLIBC_2.2.5, remove
getutmpx_2_2_5: .quad 0
.balign 8
.globl getttyent_2_2_5
.type getttyent_2_2_5, %function
.symver getttyent_2_2_5, getttyent@@GLIBC_2.2.5, remove
getttyent_2_2_5: .quad 0
.balign 8
.globl strfmon_l_2_3
.type strfmon_l_2_3, %function
.symver strfmon_l_2_3, strfmon_l@@GLIBC_2.3, remove
strfmon_l_2_3: .quad 0
.balign 8
.globl __wcstol_internal_2_2_5
.type __wcstol_internal_2_2_5, %function
.symver __wcstol_internal_2_2_5, __wcstol_internal@@GLIBC_2.2.5, remove
__wcstol_internal_2_2_5: .quad 0
.balign 8
.globl scandir64_2_2_5
.type scandir64_2_2_5, %function
.symver scandir64_2_2_5, scandir64@@GLIBC_2.2.5, remove
scandir64_2_2_5: .quad 0
.balign 8
.globl getfsfile_2_2_5
.type getfsfile_2_2_5, %function
.symver getfsfile_2_2_5, getfsfile@@GLIBC_2.2.5, remove
getfsfile_2_2_5: .quad 0
.balign 8
.globl sleep_2_2_5
.type sleep_2_2_5, %function
.symver sleep_2_2_5, sleep@@GLIBC_2.2.5, remove
sleep_2_2_5: .quad 0
.balign 8
.globl argz_append_2_2_5
.type argz_append_2_2_5, %function
.symver argz_append_2_2_5, argz_append@@GLIBC_2.2.5, remove
argz_append_2_2_5: .quad 0
.balign 8
.globl ecb_crypt_2_2_5
.type ecb_crypt_2_2_5, %function
.symver ecb_crypt_2_2_5, ecb_crypt@@GLIBC_2.2.5, remove
ecb_crypt_2_2_5: .quad 0
.balign 8
.globl xdr_rmtcall_args_2_2_5
.type xdr_rmtcall_args_2_2_5, %function
.symver xdr_rmtcall_args_2_2_5, xdr_rmtcall_args@@GLIBC_2.2.5, remove
xdr_rmtcall_args_2_2_5: .quad 0
.balign 8
.globl iconv_open_2_2_5
.type iconv_open_2_2_5, %function
.symver iconv_open_2_2_5, iconv_open@@GLIBC_2.2.5, remove
iconv_open_2_2_5: .quad 0
.balign 8
.globl fgetspent_2_2_5
.type fgetspent_2_2_5, %function
.symver fgetspent_2_2_5, fgetspent@@GLIBC_2.2.5, remove
fgetspent_2_2_5: .quad 0
.balign 8
.globl stty_2_2_5
.type stty_2_2_5, %function
.symver stty_2_2_5, stty@@GLIBC_2.2.5, remove
stty_2_2_5: .quad 0
.balign 8
.globl pthread_attr_destroy_2_2_5
.type pthread_attr_destroy_2_2_5, %function
.symver pthread_attr_destroy_2_2_5, pthread_attr_destroy@@GLIBC_2.2.5, remove
pthread_attr_destroy_2_2_5: .quad 0
.balign 8
.globl __open64_2_2_7
.type __open64_2_2_7, %function
.symver __open64_2_2_7, __open64_2@@GLIBC_2.7, remove
__open64_2_2_7: .quad 0
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
.globl bdflush_2_2_5
.type bdflush_2_2_5, %function
.symver bdflush_2_2_5, bdflush@@GLIBC_2.2.5, remove
bdflush_2_2_5: .quad 0
.balign 8
.globl setfsgid_2_2_5
.type setfsgid_2_2_5, %function
.symver setfsgid_2_2_5, setfsgid@@GLIBC_2.2.5, remove
setfsgid_2_2_5: .quad 0
.balign 8
.globl __res_randomid_2_2_5
.type __res_randomid_2_2_5, %function
.symver __res_randomid_2_2_5, __res_randomid@@GLIBC_2.2.5, remove
__res_randomid_2_2_5: .quad 0
.balign 8
.globl sigfillset_2_2_5
.type sigfillset_2_2_5, %function
.symver sigfillset_2_2_5, sigfillset@@GLIBC_2.2.5, remove
sigfillset_2_2_5: .quad 0
.balign 8
.globl __fxstatat_2_4
.type __fxstatat_2_4, %function
.symver __fxstatat_2_4, __fxstatat@@GLIBC_2.4, remove
__fxstatat_2_4: .quad 0
.balign 8
.globl __adjtimex_2_2_5
.type __adjtimex_2_2_5, %function
.symver __adjtimex_2_2_5, __adjtimex@@GLIBC_2.2.5, remove
__adjtimex_2_2_5: .quad 0
.balign 8
.globl _IO_doallocbuf_2_2_5
.type _IO_doallocbuf_2_2_5, %function
.symver _IO_doallocbuf_2_2_5, _IO_doallocbuf@@GLIBC_2.2.5, remove
_IO_doallocbuf_2_2_5: .quad 0
.balign 8
.globl __pread64_2_2_5
.type __pread64_2_2_5, %function
.symver __pread64_2_2_5, __pread64@@GLIBC_2.2.5, remove
__pread64_2_2_5: .quad 0
.balign 8
.globl qfcvt_r_2_2_5
.type qfcvt_r_2_2_5, %function
.symver qfcvt_r_2_2_5, qfcvt_r@@GLIBC_2.2.5, remove
qfcvt_r_2_2_5: .quad 0
.balign 8
.globl dl_iterate_phdr_2_2_5
.type dl_iterate_phdr_2_2_5, %function
.symver dl_iterate_phdr_2_2_5, dl_iterate_phdr@@GLIBC_2.2.5, remove
dl_iterate_phdr_2_2_5: .quad 0
.balign 8
.globl getaliasent_r_2_2_5
.type getaliasent_r_2_2_5, %function
.symver getaliasent_r_2_2_5, getaliasent_r@@GLIBC_2.2.5, remove
getaliasent_r_2_2_5: .quad 0
.balign 8
.globl ruserok_2_2_5
.type ruserok_2_2_5, %function
.symver ruserok_2_2_5, ruserok@@GLIBC_2.2.5, remove
ruserok_2_2_5: .quad 0
.balign 8
.globl msgget_2_2_5
.type msgget_2_2_5, %function
.symver msgget_2_2_5, msgget@@GLIBC_2.2.5, remove
msgget_2_2_5: .quad 0
.balign 8
.globl getservbyname_r_2_2_5
.type getservbyname_r_2_2_5, %function
.symver getservbyname_r_2_2_5, getservbyname_r@@GLIBC_2.2.5, remove
getservbyname_r_2_2_5: .quad 0
.balign 8
.globl asctime_r_2_2_5
.type asctime_r_2_2_5, %function
.symver asctime_r_2_2_5, asctime_r@@GLIBC_2.2.5, remove
asctime_r_2_2_5: .quad 0
.balign 8
.globl qecvt_2_2_5
.type qecvt_2_2_5, %function
.symver qecvt_2_2_5, qecvt@@GLIBC_2.2.5, remove
qecvt_2_2_5: .quad 0
.balign 8
.globl sigvec_2_2_5
.type sigvec_2_2_5, %function
.symver sigvec_2_2_5, sigvec@@GLIBC_2.2.5, remove
sigvec_2_2_5: .quad 0
.balign 8
.globl __stpcpy_chk_2_3_4
.type __stpcpy_chk_2_3_4, %function
.symver __stpcpy_chk_2_3_4, __stpcpy_chk@@GLIBC_2.3.4, remove
__stpcpy_chk_2_3_4: .quad 0
.balign 8
.globl setcontext_2_2_5
.type setcontext_2_2_5, %function
.symver setcontext_2_2_5, setcontext@@GLIBC_2.2.5, remove
setcontext_2_2_5: .quad 0
.balign 8
.globl __fxstat_2_2_5
.type __fxstat_2_2_5, %function
.symver __fxstat_2_2_5, __fxstat@@GLIBC_2.2.5, remove
__fxstat_2_2_5: .quad 0
.balign 8
.globl chdir_2_2_5
.type chdir_2_2_5, %function
.symver chdir_2_2_5, chdir@@GLIBC_2.2.5, remove
chdir_2_2_5: .quad 0
.balign 8
.globl _IO_wfile_overflow_2_2_5
.type _IO_wfile_overflow_2_2_5, %function
.symver _IO_wfile_overflow_2_2_5, _IO_wfile_overflow@@GLIBC_2.2.5, remove
_IO_wfile_overflow_2_2_5: .quad 0
.balign 8
.globl alarm_2_2_5
.type alarm_2_2_5, %function
.symver alarm_2_2_5, alarm@@GLIBC_2.2.5, remove
alarm_2_2_5: .quad 0
.balign 8
.globl rcmd_af_2_2_5
.type rcmd_af_2_2_5, %function
.symver rcmd_af_2_2_5, rcmd_af@@GLIBC_2.2.5, remove
rcmd_af_2_2_5: .quad 0
.balign 8
.globl munlockall_2_2_5
.type munlockall_2_2_5, %function
.symver munlockall_2_2_5, munlockall@@GLIBC_2.2.5, remove
munlockall_2_2_5: .quad 0
.balign 8
.globl _IO_str_seekoff_2_2_5
.type _IO_str_seekoff_2_2_5, %function
.symver _IO_str_seekoff_2_2_5, _IO_str_seekoff@@GLIBC_2.2.5, remove
_IO_str_seekoff_2_2_5: .quad 0
.balign 8
.globl wcscmp_2_2_5
.type wcscmp_2_2_5, %function
.symver wcscmp_2_2_5, wcscmp@@GLIBC_2.2.5, remove
wcscmp_2_2_5: .quad 0
.balign 8
.globl __nss_passwd_lookup_2_2_5
.type __nss_passwd_lookup_2_2_5, %function
.symver __nss_passwd_lookup_2_2_5, __nss_passwd_lookup@@GLIBC_2.2.5, remove
__nss_passwd_lookup_2_2_5: .quad 0
.balign 8
.globl fts_set_2_2_5
.type fts_set_2_2_5, %function
.symver fts_set_2_2_5, fts_set@@GLIBC_2.2.5, remove
fts_set_2_2_5: .quad 0
.balign 8
.globl posix_spawn_2_2_5
.type posix_spawn_2_2_5, %function
.symver posix_spawn_2_2_5, posix_spawn@GLIBC_2.2.5, remove
posix_spawn_2_2_5: .quad 0
.balign 8
.globl posix_spawn_2_15
.type posix_spawn_2_15, %function
.symver posix_spawn_2_15, posix_spawn@@GLIBC_2.15, remove
posix_spawn_2_15: .quad 0
.balign 8
.globl towlower_l_2_3
.type towlower_l_2_3, %function
.symver towlower_l_2_3, towlower_l@@GLIBC_2.3, remove
towlower_l_2_3: .quad 0
.balign 8
.globl pipe2_2_9
.type pipe2_2_9, %function
.symver pipe2_2_9, pipe2@@GLIBC_2.9, remove
pipe2_2_9: .quad 0
.balign 8
.globl __getpgid_2_2_5
.type __getpgid_2_2_5, %function
.symver __getpgid_2_2_5, __getpgid@@GLIBC_2.2.5, remove
__getpgid_2_2_5: .quad 0
.balign 8
.globl getdomainname_2_2_5
.type getdomainname_2_2_5, %function
.symver getdomainname_2_2_5, getdomainname@@GLIBC_2.2.5, remove
getdomainname_2_2_5: .quad 0
.balign 8
.globl open_memstream_2_2_5
.type open_memstream_2_2_5, %function
.symver open_memstream_2_2_5, open_memstream@@GLIBC_2.2.5, remove
open_memstream_2_2_5: .quad 0
.balign 8
.globl btowc_2_2_5
.type btowc_2_2_5, %function
.symver btowc_2_2_5, btowc@@GLIBC_2.2.5, remove
btowc_2_2_5: .quad 0
.balign 8
.globl isblank_l_2_3
.type isblank_l_2_3, %function
.symver isblank_l_2_3, isblank_l@@GLIBC_2.3, remove
isblank_l_2_3: .quad 0
.balign 8
.globl __vsscanf_2_2_5
.type __vsscanf_2_2_5, %function
.symver __vsscanf_2_2_5, __vsscanf@@GLIBC_2.2.5, remove
__vsscanf_2_2_5: .quad 0
.balign 8
.globl __recv_chk_2_4
.type __recv_chk_2_4, %function
.symver __recv_chk_2_4, __recv_chk@@GLIBC_2.4, remove
__recv_chk_2_4: .quad 0
.balign 8
.globl _IO_str_overflow_2_2_5
.type _IO_str_overflow_2_2_5, %function
.symver _IO_str_overflow_2_2_5, _IO_str_overflow@@GLIBC_2.2.5, remove
_IO_str_overflow_2_2_5: .quad 0
.balign 8
.globl __argz_stringify_2_2_5
.type __argz_stringify_2_2_5, %function
.symver __argz_stringify_2_2_5, __argz_stringify@@GLIBC_2.2.5, remove
__argz_stringify_2_2_5: .quad 0
.balign 8
.globl __finitel_2_2_5
.type __finitel_2_2_5, %function
.symver __finitel_2_2_5, __finitel@@GLIBC_2.2.5, remove
__finitel_2_2_5: .quad 0
.balign 8
.globl argp_state_help_2_2_5
.type argp_state_help_2_2_5, %function
.symver argp_state_help_2_2_5, argp_state_help@@GLIBC_2.2.5, remove
argp_state_help_2_2_5: .quad 0
.balign 8
.globl getsgnam_r_2_10
.type getsgnam_r_2_10, %function
.symver getsgnam_r_2_10, getsgnam_r@@GLIBC_2.10, remove
getsgnam_r_2_10: .quad 0
.balign 8
.globl hcreate_2_2_5
.type hcreate_2_2_5, %function
.symver hcreate_2_2_5, hcreate@@GLIBC_2.2.5, remove
hcreate_2_2_5: .quad 0
.balign 8
.globl ttyname_r_2_2_5
.type ttyname_r_2_2_5, %function
.symver ttyname_r_2_2_5, ttyname_r@@GLIBC_2.2.5, remove
ttyname_r_2_2_5: .quad 0
.balign 8
.globl fread_unlocked_2_2_5
.type fread_unlocked_2_2_5, %function
.symver fread_unlocked_2_2_5, fread_unlocked@@GLIBC_2.2.5, remove
fread_unlocked_2_2_5: .quad 0
.balign 8
.globl posix_spawnp_2_2_5
.type posix_spawnp_2_2_5, %function
.symver posix_spawnp_2_2_5, posix_spawnp@GLIBC_2.2.5, remove
posix_spawnp_2_2_5: .quad 0
.balign 8
.globl posix_spawnp_2_15
.type posix_spawnp_2_15, %function
.symver posix_spawnp_2_15, posix_spawnp@@GLIBC_2.15, remove
posix_spawnp_2_15: .quad 0
.balign 8
.globl __vfprintf_chk_2_3_4
.type __vfprintf_chk_2_3_4, %function
.symver __vfprintf_chk_2_3_4, __vfprintf_chk@@GLIBC_2.3.4, remove
__vfprintf_chk_2_3_4: .quad 0
.balign 8
.globl scandirat_2_15
.type scandirat_2_15, %function
.symver scandirat_2_15, scandirat@@GLIBC_2.15, remove
scandirat_2_15: .quad 0
.balign 8
.globl freelocale_2_3
.type freelocale_2_3, %function
.symver freelocale_2_3, freelocale@@GLIBC_2.3, remove
freelocale_2_3: .quad 0
.balign 8
.globl iswspace_l_2_3
.type iswspace_l_2_3, %function
.symver iswspace_l_2_3, iswspace_l@@GLIBC_2.3, remove
iswspace_l_2_3: .quad 0
.balign 8
.globl __libc_free_2_2_5
.type __libc_free_2_2_5, %function
.symver __libc_free_2_2_5, __libc_free@@GLIBC_2.2.5, remove
__libc_free_2_2_5: .quad 0
.balign 8
.globl nice_2_2_5
.type nice_2_2_5, %function
.symver nice_2_2_5, nice@@GLIBC_2.2.5, remove
nice_2_2_5: .quad 0
.balign 8
.globl __xmknod_2_2_5
.type __xmknod_2_2_5, %function
.symver __xmknod_2_2_5, __xmknod@@GLIBC_2.2.5, remove
__xmknod_2_2_5: .quad 0
.balign 8
.globl getmntent_2_2_5
.type getmntent_2_2_5, %function
.symver getmntent_2_2_5, getmntent@@GLIBC_2.2.5, remove
getmntent_2_2_5: .quad 0
.balign 8
.globl pthread_mutex_unlock_2_2_5
.type pthread_mutex_unlock_2_2_5, %function
.symver pthread_mutex_unlock_2_2_5, pthread_mutex_unlock@@GLIBC_2.2.5, remove
pthread_mutex_unlock_2_2_5: .quad 0
.balign 8
.globl __freading_2_2_5
.type __freading_2_2_5, %function
.symver __freading_2_2_5, __freading@@GLIBC_2.2.5, remove
__freading_2_2_5: .quad 0
.balign 8
.globl sched_setparam_2_2_5
.type sched_setparam_2_2_5, %function
.symver sched_setparam_2_2_5, sched_setparam@@GLIBC_2.2.5, remove
sched_setparam_2_2_5: .quad 0
.balign 8
.globl __libc_freeres_2_2_5
.type __libc_freeres_2_2_5, %function
.symver __libc_freeres_2_2_5, __libc_freeres@@GLIBC_2.2.5, remove
__libc_freeres_2_2_5: .quad 0
.balign 8
.globl getmntent_r_2_2_5
.type getmntent_r_2_2_5, %function
.symver getmntent_r_2_2_5, getmntent_r@@GLIBC_2.2.5, remove
getmntent_r_2_2_5: .quad 0
.balign 8
.globl getsubopt_2_2_5
.type getsubopt_2_2_5, %function
.symver getsubopt_2_2_5, getsubopt@@GLIBC_2.2.5, remove
getsubopt_2_2_5: .quad 0
.balign 8
.globl vsprintf_2_2_5
.type vsprintf_2_2_5, %function
.symver vsprintf_2_2_5, vsprintf@@GLIBC_2.2.5, remove
vsprintf_2_2_5: .quad 0
.balign 8
.globl getrusage_2_2_5
.type getrusage_2_2_5, %function
.symver getrusage_2_2_5, getrusage@@GLIBC_2.2.5, remove
getrusage_2_2_5: .quad 0
.balign 8
.globl __isalpha_l_2_2_5
.type __isalpha_l_2_2_5, %function
.symver __isalpha_l_2_2_5, __isalpha_l@@GLIBC_2.2.5, remove
__isalpha_l_2_2_5: .quad 0
.balign 8
.globl inet_pton_2_2_5
.type inet_pton_2_2_5, %function
.symver inet_pton_2_2_5, inet_pton@@GLIBC_2.2.5, remove
inet_pton_2_2_5: .quad 0
.balign 8
.globl getpt_2_2_5
.type getpt_2_2_5, %function
.symver getpt_2_2_5, getpt@@GLIBC_2.2.5, remove
getpt_2_2_5: .quad 0
.balign 8
.globl memset_2_2_5
.type memset_2_2_5, %function
.symver memset_2_2_5, memset@@GLIBC_2.2.5, remove
memset_2_2_5: .quad 0
.balign 8
.globl __wunderflow_2_2_5
.type __wunderflow_2_2_5, %function
.symver __wunderflow_2_2_5, __wunderflow@@GLIBC_2.2.5, remove
__wunderflow_2_2_5: .quad 0
.balign 8
.globl __toupper_l_2_2_5
.type __toupper_l_2_2_5, %function
.symver __toupper_l_2_2_5, __toupper_l@@GLIBC_2.2.5, remove
__toupper_l_2_2_5: .quad 0
.balign 8
.globl mbsrtowcs_2_2_5
.type mbsrtowcs_2_2_5, %function
.symver mbsrtowcs_2_2_5, mbsrtowcs@@GLIBC_2.2.5, remove
mbsrtowcs_2_2_5: .quad 0
.balign 8
.globl key_setnet_2_2_5
.type key_setnet_2_2_5, %function
.symver key_setnet_2_2_5, key_setnet@@GLIBC_2.2.5, remove
key_setnet_2_2_5: .quad 0
.balign 8
.globl svcerr_systemerr_2_2_5
.type svcerr_systemerr_2_2_5, %function
.symver svcerr_systemerr_2_2_5, svcerr_systemerr@@GLIBC_2.2.5, remove
svcerr_systemerr_2_2_5: .quad 0
.balign 8
.globl iswctype_l_2_3
.type iswctype_l_2_3, %function
.symver iswctype_l_2_3, iswctype_l@@GLIBC_2.3, remove
iswctype_l_2_3: .quad 0
.balign 8
.globl __strtok_r_1c_2_2_5
.type __strtok_r_1c_2_2_5, %function
.symver __strtok_r_1c_2_2_5, __strtok_r_1c@@GLIBC_2.2.5, remove
__strtok_r_1c_2_2_5: .quad 0
.balign 8
.globl _IO_default_doallocate_2_2_5
.type _IO_default_doallocate_2_2_5, %function
.symver _IO_default_doallocate_2_2_5, _IO_default_doallocate@@GLIBC_2.2.5, remove
_IO_default_doallocate_2_2_5: .quad 0
.balign 8
.globl fgetspent_r_2_2_5
.type fgetspent_r_2_2_5, %function
.symver fgetspent_r_2_2_5, fgetspent_r@@GLIBC_2.2.5, remove
fgetspent_r_2_2_5: .quad 0
.balign 8
.globl authdes_create_2_2_5
.type authdes_create_2_2_5, %function
.symver authdes_create_2_2_5, authdes_create@@GLIBC_2.2.5, remove
authdes_create_2_2_5: .quad 0
.balign 8
.globl iswspace_2_2_5
.type iswspace_2_2_5, %function
.symver iswspace_2_2_5, iswspace@@GLIBC_2.2.5, remove
iswspace_2_2_5: .quad 0
.balign 8
.globl __isoc99_wscanf_2_7
.type __isoc99_wscanf_2_7, %function
.symver __isoc99_wscanf_2_7, __isoc99_wscanf@@GLIBC_2.7, remove
__isoc99_wscanf_2_7: .quad 0
.balign 8
.globl swapon_2_2_5
.type swapon_2_2_5, %function
.symver swapon_2_2_5, swapon@@GLIBC_2.2.5, remove
swapon_2_2_5: .quad 0
.balign 8
.globl _IO_printf_2_2_5
.type _IO_printf_2_2_5, %function
.symver _IO_printf_2_2_5, _IO_printf@@GLIBC_2.2.5, remove
_IO_printf_2_2_5: .quad 0
.balign 8
.globl strfmon_2_2_5
.type strfmon_2_2_5, %function
.symver strfmon_2_2_5, strfmon@@GLIBC_2.2.5, remove
strfmon_2_2_5: .quad 0
.balign 8
.globl fseeko64_2_2_5
.type fseeko64_2_2_5, %function
.symver fseeko64_2_2_5, fseeko64@@GLIBC_2.2.5, remove
fseeko64_2_2_5: .quad 0
.balign 8
.globl __dup2_2_2_5
.type __dup2_2_2_5, %function
.symver __dup2_2_2_5, __dup2@@GLIBC_2.2.5, remove
__dup2_2_2_5: .quad 0
.balign 8
.globl create_module_2_2_5
.type create_module_2_2_5, %function
.symver create_module_2_2_5, create_module@@GLIBC_2.2.5, remove
create_module_2_2_5: .quad 0
.balign 8
.globl canonicalize_file_name_2_2_5
.type canonicalize_file_name_2_2_5, %function
.symver canonicalize_file_name_2_2_5, canonicalize_file_name@@GLIBC_2.2.5, remove
canonicalize_file_name_2_2_5: .quad 0
.balign 8
.globl posix_spawnattr_setpgroup_2_2_5
.type posix_spawnattr_setpgroup_2_2_5, %function
.symver posix_spawnattr_setpgroup_2_2_5, posix_spawnattr_setpgroup@@GLIBC_2.2.5, remove
posix_spawnattr_setpgroup_2_2_5: .quad 0
.balign 8
.globl getpwent_r_2_2_5
.type getpwent_r_2_2_5, %function
.symver getpwent_r_2_2_5, getpwent_r@@GLIBC_2.2.5, remove
getpwent_r_2_2_5: .quad 0
.balign 8
.globl settimeofday_2_2_5
.type settimeofday_2_2_5, %function
.symver settimeofday_2_2_5, settimeofday@@GLIBC_2.2.5, remove
settimeofday_2_2_5: .quad 0
.balign 8
.globl pselect_2_2_5
.type pselect_2_2_5, %function
.symver pselect_2_2_5, pselect@@GLIBC_2.2.5, remove
pselect_2_2_5: .quad 0
.balign 8
.globl xdr_key_netstres_2_2_5
.type xdr_key_netstres_2_2_5, %function
.symver xdr_key_netstres_2_2_5, xdr_key_netstres@@GLIBC_2.2.5, remove
xdr_key_netstres_2_2_5: .quad 0
.balign 8
.globl tmpfile_2_2_5
.type tmpfile_2_2_5, %function
.symver tmpfile_2_2_5, tmpfile@@GLIBC_2.2.5, remove
tmpfile_2_2_5: .quad 0
.balign 8
.globl dcngettext_2_2_5
.type dcngettext_2_2_5, %function
.symver dcngettext_2_2_5, dcngettext@@GLIBC_2.2.5, remove
dcngettext_2_2_5: .quad 0
.balign 8
.globl getsid_2_2_5
.type getsid_2_2_5, %function
.symver getsid_2_2_5, getsid@@GLIBC_2.2.5, remove
getsid_2_2_5: .quad 0
.balign 8
.globl sgetsgent_r_2_10
.type sgetsgent_r_2_10, %function
.symver sgetsgent_r_2_10, sgetsgent_r@@GLIBC_2.10, remove
sgetsgent_r_2_10: .quad 0
.balign 8
.globl timegm_2_2_5
.type timegm_2_2_5, %function
.symver timegm_2_2_5, timegm@@GLIBC_2.2.5, remove
timegm_2_2_5: .quad 0
.balign 8
.globl __wctrans_l_2_2_5
.type __wctrans_l_2_2_5, %function
.symver __wctrans_l_2_2_5, __wctrans_l@@GLIBC_2.2.5, remove
__wctrans_l_2_2_5: .quad 0
.balign 8
.globl fdatasync_2_2_5
.type fdatasync_2_2_5, %function
.symver fdatasync_2_2_5, fdatasync@@GLIBC_2.2.5, remove
fdatasync_2_2_5: .quad 0
.balign 8
.globl __rpc_thread_svc_pollfd_2_2_5
.type __rpc_thread_svc_pollfd_2_2_5, %function
.symver __rpc_thread_svc_pollfd_2_2_5, __rpc_thread_svc_pollfd@@GLIBC_2.2.5, remove
__rpc_thread_svc_pollfd_2_2_5: .quad 0
.balign 8
.globl llabs_2_2_5
.type llabs_2_2_5, %function
.symver llabs_2_2_5, llabs@@GLIBC_2.2.5, remove
llabs_2_2_5: .quad 0
.balign 8
.globl dcgettext_2_2_5
.type dcgettext_2_2_5, %function
.symver dcgettext_2_2_5, dcgettext@@GLIBC_2.2.5, remove
dcgettext_2_2_5: .quad 0
.balign 8
.globl iswblank_2_2_5
.type iswblank_2_2_5, %function
.symver iswblank_2_2_5, iswblank@@GLIBC_2.2.5, remove
iswblank_2_2_5: .quad 0
.balign 8
.globl vhangup_2_2_5
.type vhangup_2_2_5, %function
.symver vhangup_2_2_5, vhangup@@GLIBC_2.2.5, remove
vhangup_2_2_5: .quad 0
.balign 8
.globl open_2_2_5
.type open_2_2_5, %function
.symver open_2_2_5, open@@GLIBC_2.2.5, remove
open_2_2_5: .quad 0
.balign 8
.globl getgrnam_2_2_5
.type getgrnam_2_2_5, %function
.symver getgrnam_2_2_5, getgrnam@@GLIBC_2.2.5, remove
getgrnam_2_2_5: .quad 0
.balign 8
.globl wcstok_2_2_5
.type wcstok_2_2_5, %function
.symver wcstok_2_2_5, wcstok@@GLIBC_2.2.5, remove
wcstok_2_2_5: .quad 0
.balign 8
.globl prlimit64_2_13
.type prlimit64_2_13, %function
.symver prlimit64_2_13, prlimit64@@GLIBC_2.13, remove
prlimit64_2_13: .quad 0
.balign 8
.globl inet6_opt_find_2_5
.type inet6_opt_find_2_5, %function
.symver inet6_opt_find_2_5, inet6_opt_find@@GLIBC_2.5, remove
inet6_opt_find_2_5: .quad 0
.balign 8
.globl localeconv_2_2_5
.type localeconv_2_2_5, %function
.symver localeconv_2_2_5, localeconv@@GLIBC_2.2.5, remove
localeconv_2_2_5: .quad 0
.balign 8
.globl strchr_2_2_5
.type strchr_2_2_5, %function
.symver strchr_2_2_5, strchr@@GLIBC_2.2.5, remove
strchr_2_2_5: .quad 0
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
.globl semtimedop_2_3_3
.type semtimedop_2_3_3, %function
.symver semtimedop_2_3_3, semtimedop@@GLIBC_2.3.3, remove
semtimedop_2_3_3: .quad 0
.balign 8
.globl pthread_mutex_lock_2_2_5
.type pthread_mutex_lock_2_2_5, %function
.symver pthread_mutex_lock_2_2_5, pthread_mutex_lock@@GLIBC_2.2.5, remove
pthread_mutex_lock_2_2_5: .quad 0
.balign 8
.globl __iswalnum_l_2_2_5
.type __iswalnum_l_2_2_5, %function
.symver __iswalnum_l_2_2_5, __iswalnum_l@@GLIBC_2.2.5, remove
__iswalnum_l_2_2_5: .quad 0
.balign 8
.globl _IO_file_seek_2_2_5
.type _IO_file_seek_2_2_5, %function
.symver _IO_file_seek_2_2_5, _IO_file_seek@@GLIBC_2.2.5, remove
_IO_file_seek_2_2_5: .quad 0
.balign 8
.globl __sigsuspend_2_2_5
.type __sigsuspend_2_2_5, %function
.symver __sigsuspend_2_2_5, __sigsuspend@@GLIBC_2.2.5, remove
__sigsuspend_2_2_5: .quad 0
.balign 8
.globl __strfmon_l_2_2_5
.type __strfmon_l_2_2_5, %function
.symver __strfmon_l_2_2_5, __strfmon_l@@GLIBC_2.2.5, remove
__strfmon_l_2_2_5: .quad 0
.balign 8
.globl _IO_proc_open_2_2_5
.type _IO_proc_open_2_2_5, %function
.symver _IO_proc_open_2_2_5, _IO_proc_open@@GLIBC_2.2.5, remove
_IO_proc_open_2_2_5: .quad 0
.balign 8
.globl towupper_l_2_3
.type towupper_l_2_3, %function
.symver towupper_l_2_3, towupper_l@@GLIBC_2.3, remove
towupper_l_2_3: .quad 0
.balign 8
.globl inet6_opt_set_val_2_5
.type inet6_opt_set_val_2_5, %function
.symver inet6_opt_set_val_2_5, inet6_opt_set_val@@GLIBC_2.5, remove
inet6_opt_set_val_2_5: .quad 0
.balign 8
.globl __wcpcpy_chk_2_4
.type __wcpcpy_chk_2_4, %function
.symver __wcpcpy_chk_2_4, __wcpcpy_chk@@GLIBC_2.4, remove
__wcpcpy_chk_2_4: .quad 0
.balign 8
.globl _IO_fgetpos64_2_2_5
.type _IO_fgetpos64_2_2_5, %function
.symver _IO_fgetpos64_2_2_5, _IO_fgetpos64@@GLIBC_2.2.5, remove
_IO_fgetpos64_2_2_5: .quad 0
.balign 8
.globl key_encryptsession_2_2_5
.type key_encryptsession_2_2_5, %function
.symver key_encryptsession_2_2_5, key_encryptsession@@GLIBC_2.2.5, remove
key_encryptsession_2_2_5: .quad 0
.balign 8
.globl ffsl_2_2_5
.type ffsl_2_2_5, %function
.symver ffsl_2_2_5, ffsl@@GLIBC_2.2.5, remove
ffsl_2_2_5: .quad 0
.balign 8
.globl authunix_create_2_2_5
.type authunix_create_2_2_5, %function
.symver authunix_create_2_2_5, authunix_create@@GLIBC_2.2.5, remove
authunix_create_2_2_5: .quad 0
.balign 8
.globl wcsftime_l_2_3
.type wcsftime_l_2_3, %function
.symver wcsftime_l_2_3, wcsftime_l@@GLIBC_2.3, remove
wcsftime_l_2_3: .quad 0
.balign 8
.globl freopen64_2_2_5
.type freopen64_2_2_5, %function
.symver freopen64_2_2_5, freopen64@@GLIBC_2.2.5, remove
freopen64_2_2_5: .quad 0
.balign 8
.globl eventfd_write_2_7
.type eventfd_write_2_7, %function
.symver eventfd_write_2_7, eventfd_write@@GLIBC_2.7, remove
eventfd_write_2_7: .quad 0
.balign 8
.globl getuid_2_2_5
.type getuid_2_2_5, %function
.symver getuid_2_2_5, getuid@@GLIBC_2.2.5, remove
getuid_2_2_5: .quad 0
.balign 8
.globl ptrace_2_2_5
.type ptrace_2_2_5, %function
.symver ptrace_2_2_5, ptrace@@GLIBC_2.2.5, remove
ptrace_2_2_5: .quad 0
.balign 8
.globl authdes_getucred_2_2_5
.type authdes_getucred_2_2_5, %function
.symver authdes_getucred_2_2_5, authdes_getucred@@GLIBC_2.2.5, remove
authdes_getucred_2_2_5: .quad 0
.balign 8
.globl wcstoul_l_2_3
.type wcstoul_l_2_3, %function
.symver wcstoul_l_2_3, wcstoul_l@@GLIBC_2.3, remove
wcstoul_l_2_3: .quad 0
.balign 8
.globl rewinddir_2_2_5
.type rewinddir_2_2_5, %function
.symver rewinddir_2_2_5, rewinddir@@GLIBC_2.2.5, remove
rewinddir_2_2_5: .quad 0
.balign 8
.globl __monstartup_2_2_5
.type __monstartup_2_2_5, %function
.symver __monstartup_2_2_5, __monstartup@@GLIBC_2.2.5, remove
__monstartup_2_2_5: .quad 0
.balign 8
.globl malloc_info_2_10
.type malloc_info_2_10, %function
.symver malloc_info_2_10, malloc_info@@GLIBC_2.10, remove
malloc_info_2_10: .quad 0
.balign 8
.globl setusershell_2_2_5
.type setusershell_2_2_5, %function
.symver setusershell_2_2_5, setusershell@@GLIBC_2.2.5, remove
setusershell_2_2_5: .quad 0
.balign 8
.globl mbstowcs_2_2_5
.type mbstowcs_2_2_5, %function
.symver mbstowcs_2_2_5, mbstowcs@@GLIBC_2.2.5, remove
mbstowcs_2_2_5: .quad 0
.balign 8
.globl pthread_condattr_destroy_2_2_5
.type pthread_condattr_destroy_2_2_5, %function
.symver pthread_condattr_destroy_2_2_5, pthread_condattr_destroy@@GLIBC_2.2.5, remove
pthread_condattr_destroy_2_2_5: .quad 0
.balign 8
.globl random_2_2_5
.type random_2_2_5, %function
.symver random_2_2_5, random@@GLIBC_2.2.5, remove
random_2_2_5: .quad 0
.balign 8
.globl strtoll_l_2_3_3
.type strtoll_l_2_3_3, %function
.symver strtoll_l_2_3_3, strtoll_l@@GLIBC_2.3.3, remove
strtoll_l_2_3_3: .quad 0
.balign 8
.globl __wcstod_internal_2_2_5
.type __wcstod_internal_2_2_5, %function
.symver __wcstod_internal_2_2_5, __wcstod_internal@@GLIBC_2.2.5, remove
__wcstod_internal_2_2_5: .quad 0
.balign 8
.globl __nss_database_lookup_2_2_5
.type __nss_database_lookup_2_2_5, %function
.symver __nss_database_lookup_2_2_5, __nss_database_lookup@@GLIBC_2.2.5, remove
__nss_database_lookup_2_2_5: .quad 0
.balign 8
.globl gethostent_r_2_2_5
.type gethostent_r_2_2_5, %function
.symver gethostent_r_2_2_5, gethostent_r@@GLIBC_2.2.5, remove
gethostent_r_2_2_5: .quad 0
.balign 8
.globl toupper_l_2_3
.type toupper_l_2_3, %function
.symver toupper_l_2_3, toupper_l@@GLIBC_2.3, remove
toupper_l_2_3: .quad 0
.balign 8
.globl cuserid_2_2_5
.type cuserid_2_2_5, %function
.symver cuserid_2_2_5, cuserid@@GLIBC_2.2.5, remove
cuserid_2_2_5: .quad 0
.balign 8
.globl localtime_r_2_2_5
.type localtime_r_2_2_5, %function
.symver localtime_r_2_2_5, localtime_r@@GLIBC_2.2.5, remove
localtime_r_2_2_5: .quad 0
.balign 8
.globl wordfree_2_2_5
.type wordfree_2_2_5, %function
.symver wordfree_2_2_5, wordfree@@GLIBC_2.2.5, remove
wordfree_2_2_5: .quad 0
.balign 8
.globl __iswctype_l_2_2_5
.type __iswctype_l_2_2_5, %function
.symver __iswctype_l_2_2_5, __iswctype_l@@GLIBC_2.2.5, remove
__iswctype_l_2_2_5: .quad 0
.balign 8
.globl __strsep_3c_2_2_5
.type __strsep_3c_2_2_5, %function
.symver __strsep_3c_2_2_5, __strsep_3c@@GLIBC_2.2.5, remove
__strsep_3c_2_2_5: .quad 0
.balign 8
.globl getsourcefilter_2_3_4
.type getsourcefilter_2_3_4, %function
.symver getsourcefilter_2_3_4, getsourcefilter@@GLIBC_2.3.4, remove
getsourcefilter_2_3_4: .quad 0
.balign 8
.globl __sprintf_chk_2_3_4
.type __sprintf_chk_2_3_4, %function
.symver __sprintf_chk_2_3_4, __sprintf_chk@@GLIBC_2.3.4, remove
__sprintf_chk_2_3_4: .quad 0
.balign 8
.globl sethostid_2_2_5
.type sethostid_2_2_5, %function
.symver sethostid_2_2_5, sethostid@@GLIBC_2.2.5, remove
sethostid_2_2_5: .quad 0
.balign 8
.globl getopt_2_2_5
.type getopt_2_2_5, %function
.symver getopt_2_2_5, getopt@@GLIBC_2.2.5, remove
getopt_2_2_5: .quad 0
.balign 8
.globl copysign_2_2_5
.type copysign_2_2_5, %function
.symver copysign_2_2_5, copysign@@GLIBC_2.2.5, remove
copysign_2_2_5: .quad 0
.balign 8
.globl gethostbyname_r_2_2_5
.type gethostbyname_r_2_2_5, %function
.symver gethostbyname_r_2_2_5, gethostbyname_r@@GLIBC_2.2.5, remove
gethostbyname_r_2_2_5: .quad 0
.balign 8
.globl __mbrlen_2_2_5
.type __mbrlen_2_2_5, %function
.symver __mbrlen_2_2_5, __mbrlen@@GLIBC_2.2.5, remove
__mbrlen_2_2_5: .quad 0
.balign 8
.globl seed48_2_2_5
.type seed48_2_2_5, %function
.symver seed48_2_2_5, seed48@@GLIBC_2.2.5, remove
seed48_2_2_5: .quad 0
.balign 8
.globl getnetbyname_r_2_2_5
.type getnetbyname_r_2_2_5, %function
.symver getnetbyname_r_2_2_5, getnetbyname_r@@GLIBC_2.2.5, remove
getnetbyname_r_2_2_5: .quad 0
.balign 8
.globl __wcsxfrm_l_2_2_5
.type __wcsxfrm_l_2_2_5, %function
.symver __wcsxfrm_l_2_2_5, __wcsxfrm_l@@GLIBC_2.2.5, remove
__wcsxfrm_l_2_2_5: .quad 0
.balign 8
.globl getttynam_2_2_5
.type getttynam_2_2_5, %function
.symver getttynam_2_2_5, getttynam@@GLIBC_2.2.5, remove
getttynam_2_2_5: .quad 0
.balign 8
.globl __towctrans_2_2_5
.type __towctrans_2_2_5, %function
.symver __towctrans_2_2_5, __towctrans@@GLIBC_2.2.5, remove
__towctrans_2_2_5: .quad 0
.balign 8
.globl fgetpos64_2_2_5
.type fgetpos64_2_2_5, %function
.symver fgetpos64_2_2_5, fgetpos64@@GLIBC_2.2.5, remove
fgetpos64_2_2_5: .quad 0
.balign 8
.globl readv_2_2_5
.type readv_2_2_5, %function
.symver readv_2_2_5, readv@@GLIBC_2.2.5, remove
readv_2_2_5: .quad 0
.balign 8
.globl inet6_rth_add_2_5
.type inet6_rth_add_2_5, %function
.symver inet6_rth_add_2_5, inet6_rth_add@@GLIBC_2.5, remove
inet6_rth_add_2_5: .quad 0
.balign 8
.globl lckpwdf_2_2_5
.type lckpwdf_2_2_5, %function
.symver lckpwdf_2_2_5, lckpwdf@@GLIBC_2.2.5, remove
lckpwdf_2_2_5: .quad 0
.balign 8
.globl xdr_free_2_2_5
.type xdr_free_2_2_5, %function
.symver xdr_free_2_2_5, xdr_free@@GLIBC_2.2.5, remove
xdr_free_2_2_5: .quad 0
.balign 8
.globl __cyg_profile_func_enter_2_2_5
.type __cyg_profile_func_enter_2_2_5, %function
.symver __cyg_profile_func_enter_2_2_5, __cyg_profile_func_enter@@GLIBC_2.2.5, remove
__cyg_profile_func_enter_2_2_5: .quad 0
.balign 8
.globl __islower_l_2_2_5
.type __islower_l_2_2_5, %function
.symver __islower_l_2_2_5, __islower_l@@GLIBC_2.2.5, remove
__islower_l_2_2_5: .quad 0
.balign 8
.globl execve_2_2_5
.type execve_2_2_5, %function
.symver execve_2_2_5, execve@@GLIBC_2.2.5, remove
execve_2_2_5: .quad 0
.balign 8
.globl xdr_u_char_2_2_5
.type xdr_u_char_2_2_5, %function
.symver xdr_u_char_2_2_5, xdr_u_char@@GLIBC_2.2.5, remove
xdr_u_char_2_2_5: .quad 0
.balign 8
.globl __libc_mallopt_2_2_5
.type __libc_mallopt_2_2_5, %function
.symver __libc_mallopt_2_2_5, __libc_mallopt@@GLIBC_2.2.5, remove
__libc_mallopt_2_2_5: .quad 0
.balign 8
.globl c32rtomb_2_16
.type c32rtomb_2_16, %function
.symver c32rtomb_2_16, c32rtomb@@GLIBC_2.16, remove
c32rtomb_2_16: .quad 0
.balign 8
.globl getpublickey_2_2_5
.type getpublickey_2_2_5, %function
.symver getpublickey_2_2_5, getpublickey@@GLIBC_2.2.5, remove
getpublickey_2_2_5: .quad 0
.balign 8
.globl process_vm_readv_2_15
.type process_vm_readv_2_15, %function
.symver process_vm_readv_2_15, process_vm_readv@@GLIBC_2.15, remove
process_vm_readv_2_15: .quad 0
.balign 8
.globl mkdir_2_2_5
.type mkdir_2_2_5, %function
.symver mkdir_2_2_5, mkdir@@GLIBC_2.2.5, remove
mkdir_2_2_5: .quad 0
.balign 8
.globl wmemcmp_2_2_5
.type wmemcmp_2_2_5, %function
.symver wmemcmp_2_2_5, wmemcmp@@GLIBC_2.2.5, remove
wmemcmp_2_2_5: .quad 0
.balign 8
.globl iswgraph_l_2_3
.type iswgraph_l_2_3, %function
.symver iswgraph_l_2_3, iswgraph_l@@GLIBC_2.3, remove
iswgraph_l_2_3: .quad 0
.balign 8
.globl getpeername_2_2_5
.type getpeername_2_2_5, %function
.symver getpeername_2_2_5, getpeername@@GLIBC_2.2.5, remove
getpeername_2_2_5: .quad 0
.balign 8
.globl mmap_2_2_5
.type mmap_2_2_5, %function
.symver mmap_2_2_5, mmap@@GLIBC_2.2.5, remove
mmap_2_2_5: .quad 0
.balign 8
.globl msgsnd_2_2_5
.type msgsnd_2_2_5, %function
.symver msgsnd_2_2_5, msgsnd@@GLIBC_2.2.5, remove
msgsnd_2_2_5: .quad 0
.balign 8
.globl fanotify_init_2_13
.type fanotify_init_2_13, %function
.symver fanotify_init_2_13, fanotify_init@@GLIBC_2.13, remove
fanotify_init_2_13: .quad 0
.balign 8
.globl __vfwprintf_chk_2_4
.type __vfwprintf_chk_2_4, %function
.symver __vfwprintf_chk_2_4, __vfwprintf_chk@@GLIBC_2.4, remove
__vfwprintf_chk_2_4: .quad 0
.balign 8
.globl __nl_langinfo_l_2_2_5
.type __nl_langinfo_l_2_2_5, %function
.symver __nl_langinfo_l_2_2_5, __nl_langinfo_l@@GLIBC_2.2.5, remove
__nl_langinfo_l_2_2_5: .quad 0
.balign 8
.globl endnetgrent_2_2_5
.type endnetgrent_2_2_5, %function
.symver endnetgrent_2_2_5, endnetgrent@@GLIBC_2.2.5, remove
endnetgrent_2_2_5: .quad 0
.balign 8
.globl gethostid_2_2_5
.type gethostid_2_2_5, %function
.symver gethostid_2_2_5, gethostid@@GLIBC_2.2.5, remove
gethostid_2_2_5: .quad 0
.balign 8
.globl strpbrk_2_2_5
.type strpbrk_2_2_5, %function
.symver strpbrk_2_2_5, strpbrk@@GLIBC_2.2.5, remove
strpbrk_2_2_5: .quad 0
.balign 8
.globl strtof_2_2_5
.type strtof_2_2_5, %function
.symver strtof_2_2_5, strtof@@GLIBC_2.2.5, remove
strtof_2_2_5: .quad 0
.balign 8
.globl tempnam_2_2_5
.type tempnam_2_2_5, %function
.symver tempnam_2_2_5, tempnam@@GLIBC_2.2.5, remove
tempnam_2_2_5: .quad 0
.balign 8
.globl getprotobyname_r_2_2_5
.type getprotobyname_r_2_2_5, %function
.symver getprotobyname_r_2_2_5, getprotobyname_r@@GLIBC_2.2.5, remove
getprotobyname_r_2_2_5: .quad 0
.balign 8
.globl xprt_register_2_2_5
.type xprt_register_2_2_5, %function
.symver xprt_register_2_2_5, xprt_register@@GLIBC_2.2.5, remove
xprt_register_2_2_5: .quad 0
.balign 8
.globl lseek64_2_2_5
.type lseek64_2_2_5, %function
.symver lseek64_2_2_5, lseek64@@GLIBC_2.2.5, remove
lseek64_2_2_5: .quad 0
.balign 8
.globl register_printf_modifier_2_10
.type register_printf_modifier_2_10, %function
.symver register_printf_modifier_2_10, register_printf_modifier@@GLIBC_2.10, remove
register_printf_modifier_2_10: .quad 0
.balign 8
.globl isinf_2_2_5
.type isinf_2_2_5, %function
.symver isinf_2_2_5, isinf@@GLIBC_2.2.5, remove
isinf_2_2_5: .quad 0
.balign 8
.globl ttyslot_2_2_5
.type ttyslot_2_2_5, %function
.symver ttyslot_2_2_5, ttyslot@@GLIBC_2.2.5, remove
ttyslot_2_2_5: .quad 0
.balign 8
.globl posix_spawnattr_getsigdefault_2_2_5
.type posix_spawnattr_getsigdefault_2_2_5, %function
.symver posix_spawnattr_getsigdefault_2_2_5, posix_spawnattr_getsigdefault@@GLIBC_2.2.5, remove
posix_spawnattr_getsigdefault_2_2_5: .quad 0
.balign 8
.globl scalbnl_2_2_5
.type scalbnl_2_2_5, %function
.symver scalbnl_2_2_5, scalbnl@@GLIBC_2.2.5, remove
scalbnl_2_2_5: .quad 0
.balign 8
.globl setregid_2_2_5
.type setregid_2_2_5, %function
.symver setregid_2_2_5, setregid@@GLIBC_2.2.5, remove
setregid_2_2_5: .quad 0
.balign 8
.globl _IO_wdefault_finish_2_2_5
.type _IO_wdefault_finish_2_2_5, %function
.symver _IO_wdefault_finish_2_2_5, _IO_wdefault_finish@@GLIBC_2.2.5, remove
_IO_wdefault_finish_2_2_5: .quad 0
.balign 8
.globl scandirat64_2_15
.type scandirat64_2_15, %function
.symver scandirat64_2_15, scandirat64@@GLIBC_2.15, remove
scandirat64_2_15: .quad 0
.balign 8
.globl wcstoq_2_2_5
.type wcstoq_2_2_5, %function
.symver wcstoq_2_2_5, wcstoq@@GLIBC_2.2.5, remove
wcstoq_2_2_5: .quad 0
.balign 8
.globl swapcontext_2_2_5
.type swapcontext_2_2_5, %function
.symver swapcontext_2_2_5, swapcontext@@GLIBC_2.2.5, remove
swapcontext_2_2_5: .quad 0
.balign 8
.globl write_2_2_5
.type write_2_2_5, %function
.symver write_2_2_5, write@@GLIBC_2.2.5, remove
write_2_2_5: .quad 0
.balign 8
.globl __nss_hostname_digits_dots_2_2_5
.type __nss_hostname_digits_dots_2_2_5, %function
.symver __nss_hostname_digits_dots_2_2_5, __nss_hostname_digits_dots@@GLIBC_2.2.5, remove
__nss_hostname_digits_dots_2_2_5: .quad 0
.balign 8
.globl __strtoul_l_2_2_5
.type __strtoul_l_2_2_5, %function
.symver __strtoul_l_2_2_5, __strtoul_l@@GLIBC_2.2.5, remove
__strtoul_l_2_2_5: .quad 0
.balign 8
.globl iswcntrl_2_2_5
.type iswcntrl_2_2_5, %function
.symver iswcntrl_2_2_5, iswcntrl@@GLIBC_2.2.5, remove
iswcntrl_2_2_5: .quad 0
.balign 8
.globl ispunct_l_2_3
.type ispunct_l_2_3, %function
.symver ispunct_l_2_3, ispunct_l@@GLIBC_2.3, remove
ispunct_l_2_3: .quad 0
.balign 8
.globl endutxent_2_2_5
.type endutxent_2_2_5, %function
.symver endutxent_2_2_5, endutxent@@GLIBC_2.2.5, remove
endutxent_2_2_5: .quad 0
.balign 8
.globl send_2_2_5
.type send_2_2_5, %function
.symver send_2_2_5, send@@GLIBC_2.2.5, remove
send_2_2_5: .quad 0
.balign 8
.globl __rpc_thread_createerr_2_2_5
.type __rpc_thread_createerr_2_2_5, %function
.symver __rpc_thread_createerr_2_2_5, __rpc_thread_createerr@@GLIBC_2.2.5, remove
__rpc_thread_createerr_2_2_5: .quad 0
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
.globl sethostent_2_2_5
.type sethostent_2_2_5, %function
.symver sethostent_2_2_5, sethostent@@GLIBC_2.2.5, remove
sethostent_2_2_5: .quad 0
.balign 8
.globl _IO_wsetb_2_2_5
.type _IO_wsetb_2_2_5, %function
.symver _IO_wsetb_2_2_5, _IO_wsetb@@GLIBC_2.2.5, remove
_IO_wsetb_2_2_5: .quad 0
.balign 8
.globl unlink_2_2_5
.type unlink_2_2_5, %function
.symver unlink_2_2_5, unlink@@GLIBC_2.2.5, remove
unlink_2_2_5: .quad 0
.balign 8
.globl setjmp_2_2_5
.type setjmp_2_2_5, %function
.symver setjmp_2_2_5, setjmp@@GLIBC_2.2.5, remove
setjmp_2_2_5: .quad 0
.balign 8
.globl mprobe_2_2_5
.type mprobe_2_2_5, %function
.symver mprobe_2_2_5, mprobe@@GLIBC_2.2.5, remove
mprobe_2_2_5: .quad 0
.balign 8
.globl iswxdigit_2_2_5
.type iswxdigit_2_2_5, %function
.symver iswxdigit_2_2_5, iswxdigit@@GLIBC_2.2.5, remove
iswxdigit_2_2_5: .quad 0
.balign 8
.globl svc_getreq_common_2_2_5
.type svc_getreq_common_2_2_5, %function
.symver svc_getreq_common_2_2_5, svc_getreq_common@@GLIBC_2.2.5, remove
svc_getreq_common_2_2_5: .quad 0
.balign 8
.globl _IO_switch_to_wget_mode_2_2_5
.type _IO_switch_to_wget_mode_2_2_5, %function
.symver _IO_switch_to_wget_mode_2_2_5, _IO_switch_to_wget_mode@@GLIBC_2.2.5, remove
_IO_switch_to_wget_mode_2_2_5: .quad 0
.balign 8
.globl xdr_enum_2_2_5
.type xdr_enum_2_2_5, %function
.symver xdr_enum_2_2_5, xdr_enum@@GLIBC_2.2.5, remove
xdr_enum_2_2_5: .quad 0
.balign 8
.globl setprotoent_2_2_5
.type setprotoent_2_2_5, %function
.symver setprotoent_2_2_5, setprotoent@@GLIBC_2.2.5, remove
setprotoent_2_2_5: .quad 0
.balign 8
.globl endfsent_2_2_5
.type endfsent_2_2_5, %function
.symver endfsent_2_2_5, endfsent@@GLIBC_2.2.5, remove
endfsent_2_2_5: .quad 0
.balign 8
.globl faccessat_2_4
.type faccessat_2_4, %function
.symver faccessat_2_4, faccessat@@GLIBC_2.4, remove
faccessat_2_4: .quad 0
.balign 8
.globl getrpcbyname_2_2_5
.type getrpcbyname_2_2_5, %function
.symver getrpcbyname_2_2_5, getrpcbyname@@GLIBC_2.2.5, remove
getrpcbyname_2_2_5: .quad 0
.balign 8
.globl _Exit_2_2_5
.type _Exit_2_2_5, %function
.symver _Exit_2_2_5, _Exit@@GLIBC_2.2.5, remove
_Exit_2_2_5: .quad 0
.balign 8
.globl sigaddset_2_2_5
.type sigaddset_2_2_5, %function
.symver sigaddset_2_2_5, sigaddset@@GLIBC_2.2.5, remove
sigaddset_2_2_5: .quad 0
.balign 8
.globl __strsep_2c_2_2_5
.type __strsep_2c_2_2_5, %function
.symver __strsep_2c_2_2_5, __strsep_2c@@GLIBC_2.2.5, remove
__strsep_2c_2_2_5: .quad 0
.balign 8
.globl xdr_u_quad_t_2_3_4
.type xdr_u_quad_t_2_3_4, %function
.symver xdr_u_quad_t_2_3_4, xdr_u_quad_t@@GLIBC_2.3.4, remove
xdr_u_quad_t_2_3_4: .quad 0
.balign 8
.globl gethostname_2_2_5
.type gethostname_2_2_5, %function
.symver gethostname_2_2_5, gethostname@@GLIBC_2.2.5, remove
gethostname_2_2_5: .quad 0
.balign 8
.globl sigsuspend_2_2_5
.type sigsuspend_2_2_5, %function
.symver sigsuspend_2_2_5, sigsuspend@@GLIBC_2.2.5, remove
sigsuspend_2_2_5: .quad 0
.balign 8
.globl freeifaddrs_2_3
.type freeifaddrs_2_3, %function
.symver freeifaddrs_2_3, freeifaddrs@@GLIBC_2.3, remove
freeifaddrs_2_3: .quad 0
.balign 8
.globl shutdown_2_2_5
.type shutdown_2_2_5, %function
.symver shutdown_2_2_5, shutdown@@GLIBC_2.2.5, remove
shutdown_2_2_5: .quad 0
.balign 8
.globl xdr_array_2_2_5
.type xdr_array_2_2_5, %function
.symver xdr_array_2_2_5, xdr_array@@GLIBC_2.2.5, remove
xdr_array_2_2_5: .quad 0
.balign 8
.globl fdopen_2_2_5
.type fdopen_2_2_5, %function
.symver fdopen_2_2_5, fdopen@@GLIBC_2.2.5, remove
fdopen_2_2_5: .quad 0
.balign 8
.globl fexecve_2_2_5
.type fexecve_2_2_5, %function
.symver fexecve_2_2_5, fexecve@@GLIBC_2.2.5, remove
fexecve_2_2_5: .quad 0
.balign 8
.globl popen_2_2_5
.type popen_2_2_5, %function
.symver popen_2_2_5, popen@@GLIBC_2.2.5, remove
popen_2_2_5: .quad 0
.balign 8
.globl __lxstat64_2_2_5
.type __lxstat64_2_2_5, %function
.symver __lxstat64_2_2_5, __lxstat64@@GLIBC_2.2.5, remove
__lxstat64_2_2_5: .quad 0
.balign 8
.globl psignal_2_2_5
.type psignal_2_2_5, %function
.symver psignal_2_2_5, psignal@@GLIBC_2.2.5, remove
psignal_2_2_5: .quad 0
.balign 8
.globl putc_2_2_5
.type putc_2_2_5, %function
.symver putc_2_2_5, putc@@GLIBC_2.2.5, remove
putc_2_2_5: .quad 0
.balign 8
.globl fstatvfs_2_2_5
.type fstatvfs_2_2_5, %function
.symver fstatvfs_2_2_5, fstatvfs@@GLIBC_2.2.5, remove
fstatvfs_2_2_5: .quad 0
.balign 8
.globl posix_spawnattr_setsigdefault_2_2_5
.type posix_spawnattr_setsigdefault_2_2_5, %function
.symver posix_spawnattr_setsigdefault_2_2_5, posix_spawnattr_setsigdefault@@GLIBC_2.2.5, remove
posix_spawnattr_setsigdefault_2_2_5: .quad 0
.balign 8
.globl utmpname_2_2_5
.type utmpname_2_2_5, %function
.symver utmpname_2_2_5, utmpname@@GLIBC_2.2.5, remove
utmpname_2_2_5: .quad 0
.balign 8
.globl _seterr_reply_2_2_5
.type _seterr_reply_2_2_5, %function
.symver _seterr_reply_2_2_5, _seterr_reply@@GLIBC_2.2.5, remove
_seterr_reply_2_2_5: .quad 0
.balign 8
.globl __fsetlocking_2_2_5
.type __fsetlocking_2_2_5, %function
.symver __fsetlocking_2_2_5, __fsetlocking@@GLIBC_2.2.5, remove
__fsetlocking_2_2_5: .quad 0
.balign 8
.globl xdr_int8_t_2_2_5
.type xdr_int8_t_2_2_5, %function
.symver xdr_int8_t_2_2_5, xdr_int8_t@@GLIBC_2.2.5, remove
xdr_int8_t_2_2_5: .quad 0
.balign 8
.globl __signbit_2_2_5
.type __signbit_2_2_5, %function
.symver __signbit_2_2_5, __signbit@@GLIBC_2.2.5, remove
__signbit_2_2_5: .quad 0
.balign 8
.globl ether_ntoa_r_2_2_5
.type ether_ntoa_r_2_2_5, %function
.symver ether_ntoa_r_2_2_5, ether_ntoa_r@@GLIBC_2.2.5, remove
ether_ntoa_r_2_2_5: .quad 0
.balign 8
.globl malloc_usable_size_2_2_5
.type malloc_usable_size_2_2_5, %function
.symver malloc_usable_size_2_2_5, malloc_usable_size@@GLIBC_2.2.5, remove
malloc_usable_size_2_2_5: .quad 0
.balign 8
.globl strtoq_2_2_5
.type strtoq_2_2_5, %function
.symver strtoq_2_2_5, strtoq@@GLIBC_2.2.5, remove
strtoq_2_2_5: .quad 0
.balign 8
.globl getnetent_r_2_2_5
.type getnetent_r_2_2_5, %function
.symver getnetent_r_2_2_5, getnetent_r@@GLIBC_2.2.5, remove
getnetent_r_2_2_5: .quad 0
.balign 8
.globl xdr_sizeof_2_2_5
.type xdr_sizeof_2_2_5, %function
.symver xdr_sizeof_2_2_5, xdr_sizeof@@GLIBC_2.2.5, remove
xdr_sizeof_2_2_5: .quad 0
.balign 8
.globl vprintf_2_2_5
.type vprintf_2_2_5, %function
.symver vprintf_2_2_5, vprintf@@GLIBC_2.2.5, remove
vprintf_2_2_5: .quad 0
.balign 8
.globl gcvt_2_2_5
.type gcvt_2_2_5, %function
.symver gcvt_2_2_5, gcvt@@GLIBC_2.2.5, remove
gcvt_2_2_5: .quad 0
.balign 8
.globl getdtablesize_2_2_5
.type getdtablesize_2_2_5, %function
.symver getdtablesize_2_2_5, getdtablesize@@GLIBC_2.2.5, remove
getdtablesize_2_2_5: .quad 0
.balign 8
.globl isspace_2_2_5
.type isspace_2_2_5, %function
.symver isspace_2_2_5, isspace@@GLIBC_2.2.5, remove
isspace_2_2_5: .quad 0
.balign 8
.globl __wcstol_l_2_2_5
.type __wcstol_l_2_2_5, %function
.symver __wcstol_l_2_2_5, __wcstol_l@@GLIBC_2.2.5, remove
__wcstol_l_2_2_5: .quad 0
.balign 8
.globl __fread_unlocked_chk_2_7
.type __fread_unlocked_chk_2_7, %function
.symver __fread_unlocked_chk_2_7, __fread_unlocked_chk@@GLIBC_2.7, remove
__fread_unlocked_chk_2_7: .quad 0
.balign 8
.globl getrpcent_2_2_5
.type getrpcent_2_2_5, %function
.symver getrpcent_2_2_5, getrpcent@@GLIBC_2.2.5, remove
getrpcent_2_2_5: .quad 0
.balign 8
.globl memccpy_2_2_5
.type memccpy_2_2_5, %function
.symver memccpy_2_2_5, memccpy@@GLIBC_2.2.5, remove
memccpy_2_2_5: .quad 0
.balign 8
.globl prlimit_2_13
.type prlimit_2_13, %function
.symver prlimit_2_13, prlimit@@GLIBC_2.13, remove
prlimit_2_13: .quad 0
.balign 8
.globl __wcstombs_chk_2_4
.type __wcstombs_chk_2_4, %function
.symver __wcstombs_chk_2_4, __wcstombs_chk@@GLIBC_2.4, remove
__wcstombs_chk_2_4: .quad 0
.balign 8
.globl posix_spawn_file_actions_init_2_2_5
.type posix_spawn_file_actions_init_2_2_5, %function
.symver posix_spawn_file_actions_init_2_2_5, posix_spawn_file_actions_init@@GLIBC_2.2.5, remove
posix_spawn_file_actions_init_2_2_5: .quad 0
.balign 8
.globl iswlower_l_2_3
.type iswlower_l_2_3, %function
.symver iswlower_l_2_3, iswlower_l@@GLIBC_2.3, remove
iswlower_l_2_3: .quad 0
.balign 8
.globl endutent_2_2_5
.type endutent_2_2_5, %function
.symver endutent_2_2_5, endutent@@GLIBC_2.2.5, remove
endutent_2_2_5: .quad 0
.balign 8
.globl clntudp_bufcreate_2_2_5
.type clntudp_bufcreate_2_2_5, %function
.symver clntudp_bufcreate_2_2_5, clntudp_bufcreate@@GLIBC_2.2.5, remove
clntudp_bufcreate_2_2_5: .quad 0
.balign 8
.globl __sched_getparam_2_2_5
.type __sched_getparam_2_2_5, %function
.symver __sched_getparam_2_2_5, __sched_getparam@@GLIBC_2.2.5, remove
__sched_getparam_2_2_5: .quad 0
.balign 8
.globl remove_2_2_5
.type remove_2_2_5, %function
.symver remove_2_2_5, remove@@GLIBC_2.2.5, remove
remove_2_2_5: .quad 0
.balign 8
.globl __isspace_l_2_2_5
.type __isspace_l_2_2_5, %function
.symver __isspace_l_2_2_5, __isspace_l@@GLIBC_2.2.5, remove
__isspace_l_2_2_5: .quad 0
.balign 8
.globl timerfd_create_2_8
.type timerfd_create_2_8, %function
.symver timerfd_create_2_8, timerfd_create@@GLIBC_2.8, remove
timerfd_create_2_8: .quad 0
.balign 8
.globl sigwait_2_2_5
.type sigwait_2_2_5, %function
.symver sigwait_2_2_5, sigwait@@GLIBC_2.2.5, remove
sigwait_2_2_5: .quad 0
.balign 8
.globl stpncpy_2_2_5
.type stpncpy_2_2_5, %function
.symver stpncpy_2_2_5, stpncpy@@GLIBC_2.2.5, remove
stpncpy_2_2_5: .quad 0
.balign 8
.globl posix_fadvise64_2_2_5
.type posix_fadvise64_2_2_5, %function
.symver posix_fadvise64_2_2_5, posix_fadvise64@@GLIBC_2.2.5, remove
posix_fadvise64_2_2_5: .quad 0
.balign 8
.globl getpid_2_2_5
.type getpid_2_2_5, %function
.symver getpid_2_2_5, getpid@@GLIBC_2.2.5, remove
getpid_2_2_5: .quad 0
.balign 8
.globl __wmemset_chk_2_4
.type __wmemset_chk_2_4, %function
.symver __wmemset_chk_2_4, __wmemset_chk@@GLIBC_2.4, remove
__wmemset_chk_2_4: .quad 0
.balign 8
.globl __isnanf_2_2_5
.type __isnanf_2_2_5, %function
.symver __isnanf_2_2_5, __isnanf@@GLIBC_2.2.5, remove
__isnanf_2_2_5: .quad 0
.balign 8
.globl fileno_unlocked_2_2_5
.type fileno_unlocked_2_2_5, %function
.symver fileno_unlocked_2_2_5, fileno_unlocked@@GLIBC_2.2.5, remove
fileno_unlocked_2_2_5: .quad 0
.balign 8
.globl accept_2_2_5
.type accept_2_2_5, %function
.symver accept_2_2_5, accept@@GLIBC_2.2.5, remove
accept_2_2_5: .quad 0
.balign 8
.globl posix_spawn_file_actions_destroy_2_2_5
.type posix_spawn_file_actions_destroy_2_2_5, %function
.symver posix_spawn_file_actions_destroy_2_2_5, posix_spawn_file_actions_destroy@@GLIBC_2.2.5, remove
posix_spawn_file_actions_destroy_2_2_5: .quad 0
.balign 8
.globl unlockpt_2_2_5
.type unlockpt_2_2_5, %function
.symver unlockpt_2_2_5, unlockpt@@GLIBC_2.2.5, remove
unlockpt_2_2_5: .quad 0
.balign 8
.globl __stpcpy_2_2_5
.type __stpcpy_2_2_5, %function
.symver __stpcpy_2_2_5, __stpcpy@@GLIBC_2.2.5, remove
__stpcpy_2_2_5: .quad 0
.balign 8
.globl __recvfrom_chk_2_4
.type __recvfrom_chk_2_4, %function
.symver __recvfrom_chk_2_4, __recvfrom_chk@@GLIBC_2.4, remove
__recvfrom_chk_2_4: .quad 0
.balign 8
.globl ftruncate_2_2_5
.type ftruncate_2_2_5, %function
.symver ftruncate_2_2_5, ftruncate@@GLIBC_2.2.5, remove
ftruncate_2_2_5: .quad 0
.balign 8
.globl getsockopt_2_2_5
.type getsockopt_2_2_5, %function
.symver getsockopt_2_2_5, getsockopt@@GLIBC_2.2.5, remove
getsockopt_2_2_5: .quad 0
.balign 8
.globl envz_get_2_2_5
.type envz_get_2_2_5, %function
.symver envz_get_2_2_5, envz_get@@GLIBC_2.2.5, remove
envz_get_2_2_5: .quad 0
.balign 8
.globl getdate_2_2_5
.type getdate_2_2_5, %function
.symver getdate_2_2_5, getdate@@GLIBC_2.2.5, remove
getdate_2_2_5: .quad 0
.balign 8
.globl wcstold_2_2_5
.type wcstold_2_2_5, %function
.symver wcstold_2_2_5, wcstold@@GLIBC_2.2.5, remove
wcstold_2_2_5: .quad 0
.balign 8
.globl __rawmemchr_2_2_5
.type __rawmemchr_2_2_5, %function
.symver __rawmemchr_2_2_5, __rawmemchr@@GLIBC_2.2.5, remove
__rawmemchr_2_2_5: .quad 0
.balign 8
.globl wcstold_l_2_3
.type wcstold_l_2_3, %function
.symver wcstold_l_2_3, wcstold_l@@GLIBC_2.3, remove
wcstold_l_2_3: .quad 0
.balign 8
.globl __mempcpy_chk_2_3_4
.type __mempcpy_chk_2_3_4, %function
.symver __mempcpy_chk_2_3_4, __mempcpy_chk@@GLIBC_2.3.4, remove
__mempcpy_chk_2_3_4: .quad 0
.balign 8
.globl __getpid_2_2_5
.type __getpid_2_2_5, %function
.symver __getpid_2_2_5, __getpid@@GLIBC_2.2.5, remove
__getpid_2_2_5: .quad 0
.balign 8
.globl __mbsrtowcs_chk_2_4
.type __mbsrtowcs_chk_2_4, %function
.symver __mbsrtowcs_chk_2_4, __mbsrtowcs_chk@@GLIBC_2.4, remove
__mbsrtowcs_chk_2_4: .quad 0
.balign 8
.globl iconv_2_2_5
.type iconv_2_2_5, %function
.symver iconv_2_2_5, iconv@@GLIBC_2.2.5, remove
iconv_2_2_5: .quad 0
.balign 8
.globl pmap_set_2_2_5
.type pmap_set_2_2_5, %function
.symver pmap_set_2_2_5, pmap_set@@GLIBC_2.2.5, remove
pmap_set_2_2_5: .quad 0
.balign 8
.globl sigisemptyset_2_2_5
.type sigisemptyset_2_2_5, %function
.symver sigisemptyset_2_2_5, sigisemptyset@@GLIBC_2.2.5, remove
sigisemptyset_2_2_5: .quad 0
.balign 8
.globl authunix_create_default_2_2_5
.type authunix_create_default_2_2_5, %function
.symver authunix_create_default_2_2_5, authunix_create_default@@GLIBC_2.2.5, remove
authunix_create_default_2_2_5: .quad 0
.balign 8
.globl pthread_attr_getschedparam_2_2_5
.type pthread_attr_getschedparam_2_2_5, %function
.symver pthread_attr_getschedparam_2_2_5, pthread_attr_getschedparam@@GLIBC_2.2.5, remove
pthread_attr_getschedparam_2_2_5: .quad 0
.balign 8
.globl if_indextoname_2_2_5
.type if_indextoname_2_2_5, %function
.symver if_indextoname_2_2_5, if_indextoname@@GLIBC_2.2.5, remove
if_indextoname_2_2_5: .quad 0
.balign 8
.globl ustat_2_2_5
.type ustat_2_2_5, %function
.symver ustat_2_2_5, ustat@@GLIBC_2.2.5, remove
ustat_2_2_5: .quad 0
.balign 8
.globl munmap_2_2_5
.type munmap_2_2_5, %function
.symver munmap_2_2_5, munmap@@GLIBC_2.2.5, remove
munmap_2_2_5: .quad 0
.balign 8
.globl pwritev_2_10
.type pwritev_2_10, %function
.symver pwritev_2_10, pwritev@@GLIBC_2.10, remove
pwritev_2_10: .quad 0
.balign 8
.globl sigismember_2_2_5
.type sigismember_2_2_5, %function
.symver sigismember_2_2_5, sigismember@@GLIBC_2.2.5, remove
sigismember_2_2_5: .quad 0
.balign 8
.globl setfsent_2_2_5
.type setfsent_2_2_5, %function
.symver setfsent_2_2_5, setfsent@@GLIBC_2.2.5, remove
setfsent_2_2_5: .quad 0
.balign 8
.globl argz_create_2_2_5
.type argz_create_2_2_5, %function
.symver argz_create_2_2_5, argz_create@@GLIBC_2.2.5, remove
argz_create_2_2_5: .quad 0
.balign 8
.globl wcsrchr_2_2_5
.type wcsrchr_2_2_5, %function
.symver wcsrchr_2_2_5, wcsrchr@@GLIBC_2.2.5, remove
wcsrchr_2_2_5: .quad 0
.balign 8
.globl setvbuf_2_2_5
.type setvbuf_2_2_5, %function
.symver setvbuf_2_2_5, setvbuf@@GLIBC_2.2.5, remove
setvbuf_2_2_5: .quad 0
.balign 8
.globl cfgetospeed_2_2_5
.type cfgetospeed_2_2_5, %function
.symver cfgetospeed_2_2_5, cfgetospeed@@GLIBC_2.2.5, remove
cfgetospeed_2_2_5: .quad 0
.balign 8
.globl __dcgettext_2_2_5
.type __dcgettext_2_2_5, %function
.symver __dcgettext_2_2_5, __dcgettext@@GLIBC_2.2.5, remove
__dcgettext_2_2_5: .quad 0
.balign 8
.globl xdr_pmap_2_2_5
.type xdr_pmap_2_2_5, %function
.symver xdr_pmap_2_2_5, xdr_pmap@@GLIBC_2.2.5, remove
xdr_pmap_2_2_5: .quad 0
.balign 8
.globl setsgent_2_10
.type setsgent_2_10, %function
.symver setsgent_2_10, setsgent@@GLIBC_2.10, remove
setsgent_2_10: .quad 0
.balign 8
.globl svctcp_create_2_2_5
.type svctcp_create_2_2_5, %function
.symver svctcp_create_2_2_5, svctcp_create@@GLIBC_2.2.5, remove
svctcp_create_2_2_5: .quad 0
.balign 8
.globl __fentry___2_13
.type __fentry___2_13, %function
.symver __fentry___2_13, __fentry__@@GLIBC_2.13, remove
__fentry___2_13: .quad 0
.balign 8
.globl obstack_free_2_2_5
.type obstack_free_2_2_5, %function
.symver obstack_free_2_2_5, obstack_free@@GLIBC_2.2.5, remove
obstack_free_2_2_5: .quad 0
.balign 8
.globl __res_nclose_2_2_5
.type __res_nclose_2_2_5, %function
.symver __res_nclose_2_2_5, __res_nclose@@GLIBC_2.2.5, remove
__res_nclose_2_2_5: .quad 0
.balign 8
.globl regcomp_2_2_5
.type regcomp_2_2_5, %function
.symver regcomp_2_2_5, regcomp@@GLIBC_2.2.5, remove
regcomp_2_2_5: .quad 0
.balign 8
.globl fstatfs_2_2_5
.type fstatfs_2_2_5, %function
.symver fstatfs_2_2_5, fstatfs@@GLIBC_2.2.5, remove
fstatfs_2_2_5: .quad 0
.balign 8
.globl setpriority_2_2_5
.type setpriority_2_2_5, %function
.symver setpriority_2_2_5, setpriority@@GLIBC_2.2.5, remove
setpriority_2_2_5: .quad 0
.balign 8
.globl __wcstoul_l_2_2_5
.type __wcstoul_l_2_2_5, %function
.symver __wcstoul_l_2_2_5, __wcstoul_l@@GLIBC_2.2.5, remove
__wcstoul_l_2_2_5: .quad 0
.balign 8
.globl clock_gettime_2_17
.type clock_gettime_2_17, %function
.symver clock_gettime_2_17, clock_gettime@@GLIBC_2.17, remove
clock_gettime_2_17: .quad 0
.balign 8
.globl modff_2_2_5
.type modff_2_2_5, %function
.symver modff_2_2_5, modff@@GLIBC_2.2.5, remove
modff_2_2_5: .quad 0
.balign 8
.globl access_2_2_5
.type access_2_2_5, %function
.symver access_2_2_5, access@@GLIBC_2.2.5, remove
access_2_2_5: .quad 0
.balign 8
.globl ftok_2_2_5
.type ftok_2_2_5, %function
.symver ftok_2_2_5, ftok@@GLIBC_2.2.5, remove
ftok_2_2_5: .quad 0
.balign 8
.globl _IO_peekc_locked_2_2_5
.type _IO_peekc_locked_2_2_5, %function
.symver _IO_peekc_locked_2_2_5, _IO_peekc_locked@@GLIBC_2.2.5, remove
_IO_peekc_locked_2_2_5: .quad 0
.balign 8
.globl dgettext_2_2_5
.type dgettext_2_2_5, %function
.symver dgettext_2_2_5, dgettext@@GLIBC_2.2.5, remove
dgettext_2_2_5: .quad 0
.balign 8
.globl getloadavg_2_2_5
.type getloadavg_2_2_5, %function
.symver getloadavg_2_2_5, getloadavg@@GLIBC_2.2.5, remove
getloadavg_2_2_5: .quad 0
.balign 8
.globl strtoul_2_2_5
.type strtoul_2_2_5, %function
.symver strtoul_2_2_5, strtoul@@GLIBC_2.2.5, remove
strtoul_2_2_5: .quad 0
.balign 8
.globl __setpgid_2_2_5
.type __setpgid_2_2_5, %function
.symver __setpgid_2_2_5, __setpgid@@GLIBC_2.2.5, remove
__setpgid_2_2_5: .quad 0
.balign 8
.globl __vwprintf_chk_2_4
.type __vwprintf_chk_2_4, %function
.symver __vwprintf_chk_2_4, __vwprintf_chk@@GLIBC_2.4, remove
__vwprintf_chk_2_4: .quad 0
.balign 8
.globl pthread_attr_setscope_2_2_5
.type pthread_attr_setscope_2_2_5, %function
.symver pthread_attr_setscope_2_2_5, pthread_attr_setscope@@GLIBC_2.2.5, remove
pthread_attr_setscope_2_2_5: .quad 0
.balign 8
.globl __gethostname_chk_2_4
.type __gethostname_chk_2_4, %function
.symver __gethostname_chk_2_4, __gethostname_chk@@GLIBC_2.4, remove
__gethostname_chk_2_4: .quad 0
.balign 8
.globl __mbrtowc_2_2_5
.type __mbrtowc_2_2_5, %function
.symver __mbrtowc_2_2_5, __mbrtowc@@GLIBC_2.2.5, remove
__mbrtowc_2_2_5: .quad 0
.balign 8
.globl __pread_chk_2_4
.type __pread_chk_2_4, %function
.symver __pread_chk_2_4, __pread_chk@@GLIBC_2.4, remove
__pread_chk_2_4: .quad 0
.balign 8
.globl wcstoul_2_2_5
.type wcstoul_2_2_5, %function
.symver wcstoul_2_2_5, wcstoul@@GLIBC_2.2.5, remove
wcstoul_2_2_5: .quad 0
.balign 8
.globl endrpcent_2_2_5
.type endrpcent_2_2_5, %function
.symver endrpcent_2_2_5, endrpcent@@GLIBC_2.2.5, remove
endrpcent_2_2_5: .quad 0
.balign 8
.globl svc_run_2_2_5
.type svc_run_2_2_5, %function
.symver svc_run_2_2_5, svc_run@@GLIBC_2.2.5, remove
svc_run_2_2_5: .quad 0
.balign 8
.globl strcoll_2_2_5
.type strcoll_2_2_5, %function
.symver strcoll_2_2_5, strcoll@@GLIBC_2.2.5, remove
strcoll_2_2_5: .quad 0
.balign 8
.globl __res_ninit_2_2_5
.type __res_ninit_2_2_5, %function
.symver __res_ninit_2_2_5, __res_ninit@@GLIBC_2.2.5, remove
__res_ninit_2_2_5: .quad 0
.balign 8
.globl feof_unlocked_2_2_5
.type feof_unlocked_2_2_5, %function
.symver feof_unlocked_2_2_5, feof_unlocked@@GLIBC_2.2.5, remove
feof_unlocked_2_2_5: .quad 0
.balign 8
.globl lutimes_2_3
.type lutimes_2_3, %function
.symver lutimes_2_3, lutimes@@GLIBC_2.3, remove
lutimes_2_3: .quad 0
.balign 8
.globl __vsnprintf_2_2_5
.type __vsnprintf_2_2_5, %function
.symver __vsnprintf_2_2_5, __vsnprintf@@GLIBC_2.2.5, remove
__vsnprintf_2_2_5: .quad 0
.balign 8
.globl initstate_2_2_5
.type initstate_2_2_5, %function
.symver initstate_2_2_5, initstate@@GLIBC_2.2.5, remove
initstate_2_2_5: .quad 0
.balign 8
.globl xdrrec_skiprecord_2_2_5
.type xdrrec_skiprecord_2_2_5, %function
.symver xdrrec_skiprecord_2_2_5, xdrrec_skiprecord@@GLIBC_2.2.5, remove
xdrrec_skiprecord_2_2_5: .quad 0
.balign 8
.globl revoke_2_2_5
.type revoke_2_2_5, %function
.symver revoke_2_2_5, revoke@@GLIBC_2.2.5, remove
revoke_2_2_5: .quad 0
.balign 8
.globl clearenv_2_2_5
.type clearenv_2_2_5, %function
.symver clearenv_2_2_5, clearenv@@GLIBC_2.2.5, remove
clearenv_2_2_5: .quad 0
.balign 8
.globl mkdtemp_2_2_5
.type mkdtemp_2_2_5, %function
.symver mkdtemp_2_2_5, mkdtemp@@GLIBC_2.2.5, remove
mkdtemp_2_2_5: .quad 0
.balign 8
.globl open_wmemstream_2_4
.type open_wmemstream_2_4, %function
.symver open_wmemstream_2_4, open_wmemstream@@GLIBC_2.4, remove
open_wmemstream_2_4: .quad 0
.balign 8
.globl copysignl_2_2_5
.type copysignl_2_2_5, %function
.symver copysignl_2_2_5, copysignl@@GLIBC_2.2.5, remove
copysignl_2_2_5: .quad 0
.balign 8
.globl fmemopen_2_2_5
.type fmemopen_2_2_5, %function
.symver fmemopen_2_2_5, fmemopen@@GLIBC_2.2.5, remove
fmemopen_2_2_5: .quad 0
.balign 8
.globl inet_network_2_2_5
.type inet_network_2_2_5, %function
.symver inet_network_2_2_5, inet_network@@GLIBC_2.2.5, remove
inet_network_2_2_5: .quad 0
.balign 8
.globl __wcrtomb_chk_2_4
.type __wcrtomb_chk_2_4, %function
.symver __wcrtomb_chk_2_4, __wcrtomb_chk@@GLIBC_2.4, remove
__wcrtomb_chk_2_4: .quad 0
.balign 8
.globl nl_langinfo_l_2_3
.type nl_langinfo_l_2_3, %function
.symver nl_langinfo_l_2_3, nl_langinfo_l@@GLIBC_2.3, remove
nl_langinfo_l_2_3: .quad 0
.balign 8
.globl dup_2_2_5
.type dup_2_2_5, %function
.symver dup_2_2_5, dup@@GLIBC_2.2.5, remove
dup_2_2_5: .quad 0
.balign 8
.globl fchown_2_2_5
.type fchown_2_2_5, %function
.symver fchown_2_2_5, fchown@@GLIBC_2.2.5, remove
fchown_2_2_5: .quad 0
.balign 8
.globl sigdelset_2_2_5
.type sigdelset_2_2_5, %function
.symver sigdelset_2_2_5, sigdelset@@GLIBC_2.2.5, remove
sigdelset_2_2_5: .quad 0
.balign 8
.globl __finite_2_2_5
.type __finite_2_2_5, %function
.symver __finite_2_2_5, __finite@@GLIBC_2.2.5, remove
__finite_2_2_5: .quad 0
.balign 8
.globl vwarn_2_2_5
.type vwarn_2_2_5, %function
.symver vwarn_2_2_5, vwarn@@GLIBC_2.2.5, remove
vwarn_2_2_5: .quad 0
.balign 8
.globl dngettext_2_2_5
.type dngettext_2_2_5, %function
.symver dngettext_2_2_5, dngettext@@GLIBC_2.2.5, remove
dngettext_2_2_5: .quad 0
.balign 8
.globl putw_2_2_5
.type putw_2_2_5, %function
.symver putw_2_2_5, putw@@GLIBC_2.2.5, remove
putw_2_2_5: .quad 0
.balign 8
.globl _IO_file_underflow_2_2_5
.type _IO_file_underflow_2_2_5, %function
.symver _IO_file_underflow_2_2_5, _IO_file_underflow@@GLIBC_2.2.5, remove
_IO_file_underflow_2_2_5: .quad 0
.balign 8
.globl ftell_2_2_5
.type ftell_2_2_5, %function
.symver ftell_2_2_5, ftell@@GLIBC_2.2.5, remove
ftell_2_2_5: .quad 0
.balign 8
.globl _IO_wdefault_pbackfail_2_2_5
.type _IO_wdefault_pbackfail_2_2_5, %function
.symver _IO_wdefault_pbackfail_2_2_5, _IO_wdefault_pbackfail@@GLIBC_2.2.5, remove
_IO_wdefault_pbackfail_2_2_5: .quad 0
.balign 8
.globl if_nameindex_2_2_5
.type if_nameindex_2_2_5, %function
.symver if_nameindex_2_2_5, if_nameindex@@GLIBC_2.2.5, remove
if_nameindex_2_2_5: .quad 0
.balign 8
.globl epoll_create_2_3_2
.type epoll_create_2_3_2, %function
.symver epoll_create_2_3_2, epoll_create@@GLIBC_2.3.2, remove
epoll_create_2_3_2: .quad 0
.balign 8
.globl xdr_pointer_2_2_5
.type xdr_pointer_2_2_5, %function
.symver xdr_pointer_2_2_5, xdr_pointer@@GLIBC_2.2.5, remove
xdr_pointer_2_2_5: .quad 0
.balign 8
.globl putgrent_2_2_5
.type putgrent_2_2_5, %function
.symver putgrent_2_2_5, putgrent@@GLIBC_2.2.5, remove
putgrent_2_2_5: .quad 0
.balign 8
.globl tdelete_2_2_5
.type tdelete_2_2_5, %function
.symver tdelete_2_2_5, tdelete@@GLIBC_2.2.5, remove
tdelete_2_2_5: .quad 0
.balign 8
.globl _IO_least_wmarker_2_2_5
.type _IO_least_wmarker_2_2_5, %function
.symver _IO_least_wmarker_2_2_5, _IO_least_wmarker@@GLIBC_2.2.5, remove
_IO_least_wmarker_2_2_5: .quad 0
.balign 8
.globl __statfs_2_2_5
.type __statfs_2_2_5, %function
.symver __statfs_2_2_5, __statfs@@GLIBC_2.2.5, remove
__statfs_2_2_5: .quad 0
.balign 8
.globl __wmemcpy_chk_2_4
.type __wmemcpy_chk_2_4, %function
.symver __wmemcpy_chk_2_4, __wmemcpy_chk@@GLIBC_2.4, remove
__wmemcpy_chk_2_4: .quad 0
.balign 8
.globl _IO_wdefault_doallocate_2_2_5
.type _IO_wdefault_doallocate_2_2_5, %function
.symver _IO_wdefault_doallocate_2_2_5, _IO_wdefault_doallocate@@GLIBC_2.2.5, remove
_IO_wdefault_doallocate_2_2_5: .quad 0
.balign 8
.globl setrlimit64_2_2_5
.type setrlimit64_2_2_5, %function
.symver setrlimit64_2_2_5, setrlimit64@@GLIBC_2.2.5, remove
setrlimit64_2_2_5: .quad 0
.balign 8
.globl strftime_2_2_5
.type strftime_2_2_5, %function
.symver strftime_2_2_5, strftime@@GLIBC_2.2.5, remove
strftime_2_2_5: .quad 0
.balign 8
.globl __register_atfork_2_3_2
.type __register_atfork_2_3_2, %function
.symver __register_atfork_2_3_2, __register_atfork@@GLIBC_2.3.2, remove
__register_atfork_2_3_2: .quad 0
.balign 8
.globl wmemcpy_2_2_5
.type wmemcpy_2_2_5, %function
.symver wmemcpy_2_2_5, wmemcpy@@GLIBC_2.2.5, remove
wmemcpy_2_2_5: .quad 0
.balign 8
.globl __libc_allocate_rtsig_2_2_5
.type __libc_allocate_rtsig_2_2_5, %function
.symver __libc_allocate_rtsig_2_2_5, __libc_allocate_rtsig@@GLIBC_2.2.5, remove
__libc_allocate_rtsig_2_2_5: .quad 0
.balign 8
.globl fileno_2_2_5
.type fileno_2_2_5, %function
.symver fileno_2_2_5, fileno@@GLIBC_2.2.5, remove
fileno_2_2_5: .quad 0
.balign 8
.globl delete_module_2_2_5
.type delete_module_2_2_5, %function
.symver delete_module_2_2_5, delete_module@@GLIBC_2.2.5, remove
delete_module_2_2_5: .quad 0
.balign 8
.globl _IO_default_uflow_2_2_5
.type _IO_default_uflow_2_2_5, %function
.symver _IO_default_uflow_2_2_5, _IO_default_uflow@@GLIBC_2.2.5, remove
_IO_default_uflow_2_2_5: .quad 0
.balign 8
.globl argz_delete_2_2_5
.type argz_delete_2_2_5, %function
.symver argz_delete_2_2_5, argz_delete@@GLIBC_2.2.5, remove
argz_delete_2_2_5: .quad 0
.balign 8
.globl realloc_2_2_5
.type realloc_2_2_5, %function
.symver realloc_2_2_5, realloc@@GLIBC_2.2.5, remove
realloc_2_2_5: .quad 0
.balign 8
.globl read_2_2_5
.type read_2_2_5, %function
.symver read_2_2_5, read@@GLIBC_2.2.5, remove
read_2_2_5: .quad 0
.balign 8
.globl wcstoll_2_2_5
.type wcstoll_2_2_5, %function
.symver wcstoll_2_2_5, wcstoll@@GLIBC_2.2.5, remove
wcstoll_2_2_5: .quad 0
.balign 8
.globl asprintf_2_2_5
.type asprintf_2_2_5, %function
.symver asprintf_2_2_5, asprintf@@GLIBC_2.2.5, remove
asprintf_2_2_5: .quad 0
.balign 8
.globl posix_openpt_2_2_5
.type posix_openpt_2_2_5, %function
.symver posix_openpt_2_2_5, posix_openpt@@GLIBC_2.2.5, remove
posix_openpt_2_2_5: .quad 0
.balign 8
.globl __posix_getopt_2_10
.type __posix_getopt_2_10, %function
.symver __posix_getopt_2_10, __posix_getopt@@GLIBC_2.10, remove
__posix_getopt_2_10: .quad 0
.balign 8
.globl wctomb_2_2_5
.type wctomb_2_2_5, %function
.symver wctomb_2_2_5, wctomb@@GLIBC_2.2.5, remove
wctomb_2_2_5: .quad 0
.balign 8
.globl _IO_default_pbackfail_2_2_5
.type _IO_default_pbackfail_2_2_5, %function
.symver _IO_default_pbackfail_2_2_5, _IO_default_pbackfail@@GLIBC_2.2.5, remove
_IO_default_pbackfail_2_2_5: .quad 0
.balign 8
.globl argz_replace_2_2_5
.type argz_replace_2_2_5, %function
.symver argz_replace_2_2_5, argz_replace@@GLIBC_2.2.5, remove
argz_replace_2_2_5: .quad 0
.balign 8
.globl getnetgrent_r_2_2_5
.type getnetgrent_r_2_2_5, %function
.symver getnetgrent_r_2_2_5, getnetgrent_r@@GLIBC_2.2.5, remove
getnetgrent_r_2_2_5: .quad 0
.balign 8
.globl __iswspace_l_2_2_5
.type __iswspace_l_2_2_5, %function
.symver __iswspace_l_2_2_5, __iswspace_l@@GLIBC_2.2.5, remove
__iswspace_l_2_2_5: .quad 0
.balign 8
.globl setitimer_2_2_5
.type setitimer_2_2_5, %function
.symver setitimer_2_2_5, setitimer@@GLIBC_2.2.5, remove
setitimer_2_2_5: .quad 0
.balign 8
.globl xdr_void_2_2_5
.type xdr_void_2_2_5, %function
.symver xdr_void_2_2_5, xdr_void@@GLIBC_2.2.5, remove
xdr_void_2_2_5: .quad 0
.balign 8
.globl ngettext_2_2_5
.type ngettext_2_2_5, %function
.symver ngettext_2_2_5, ngettext@@GLIBC_2.2.5, remove
ngettext_2_2_5: .quad 0
.balign 8
.globl time_2_2_5
.type time_2_2_5, %function
.symver time_2_2_5, time@@GLIBC_2.2.5, remove
time_2_2_5: .quad 0
.balign 8
.globl setsockopt_2_2_5
.type setsockopt_2_2_5, %function
.symver setsockopt_2_2_5, setsockopt@@GLIBC_2.2.5, remove
setsockopt_2_2_5: .quad 0
.balign 8
.globl fputwc_unlocked_2_2_5
.type fputwc_unlocked_2_2_5, %function
.symver fputwc_unlocked_2_2_5, fputwc_unlocked@@GLIBC_2.2.5, remove
fputwc_unlocked_2_2_5: .quad 0
.balign 8
.globl iswblank_l_2_3
.type iswblank_l_2_3, %function
.symver iswblank_l_2_3, iswblank_l@@GLIBC_2.3, remove
iswblank_l_2_3: .quad 0
.balign 8
.globl difftime_2_2_5
.type difftime_2_2_5, %function
.symver difftime_2_2_5, difftime@@GLIBC_2.2.5, remove
difftime_2_2_5: .quad 0
.balign 8
.globl fflush_unlocked_2_2_5
.type fflush_unlocked_2_2_5, %function
.symver fflush_unlocked_2_2_5, fflush_unlocked@@GLIBC_2.2.5, remove
fflush_unlocked_2_2_5: .quad 0
.balign 8
.globl _IO_flush_all_2_2_5
.type _IO_flush_all_2_2_5, %function
.symver _IO_flush_all_2_2_5, _IO_flush_all@@GLIBC_2.2.5, remove
_IO_flush_all_2_2_5: .quad 0
.balign 8
.globl getchar_unlocked_2_2_5
.type getchar_unlocked_2_2_5, %function
.symver getchar_unlocked_2_2_5, getchar_unlocked@@GLIBC_2.2.5, remove
getchar_unlocked_2_2_5: .quad 0
.balign 8
.globl __strtod_internal_2_2_5
.type __strtod_internal_2_2_5, %function
.symver __strtod_internal_2_2_5, __strtod_internal@@GLIBC_2.2.5, remove
__strtod_internal_2_2_5: .quad 0
.balign 8
.globl __strtoul_internal_2_2_5
.type __strtoul_internal_2_2_5, %function
.symver __strtoul_internal_2_2_5, __strtoul_internal@@GLIBC_2.2.5, remove
__strtoul_internal_2_2_5: .quad 0
.balign 8
.globl __strncat_chk_2_3_4
.type __strncat_chk_2_3_4, %function
.symver __strncat_chk_2_3_4, __strncat_chk@@GLIBC_2.3.4, remove
__strncat_chk_2_3_4: .quad 0
.balign 8
.globl setreuid_2_2_5
.type setreuid_2_2_5, %function
.symver setreuid_2_2_5, setreuid@@GLIBC_2.2.5, remove
setreuid_2_2_5: .quad 0
.balign 8
.globl bind_textdomain_codeset_2_2_5
.type bind_textdomain_codeset_2_2_5, %function
.symver bind_textdomain_codeset_2_2_5, bind_textdomain_codeset@@GLIBC_2.2.5, remove
bind_textdomain_codeset_2_2_5: .quad 0
.balign 8
.globl argp_usage_2_2_5
.type argp_usage_2_2_5, %function
.symver argp_usage_2_2_5, argp_usage@@GLIBC_2.2.5, remove
argp_usage_2_2_5: .quad 0
.balign 8
.globl isprint_l_2_3
.type isprint_l_2_3, %function
.symver isprint_l_2_3, isprint_l@@GLIBC_2.3, remove
isprint_l_2_3: .quad 0
.balign 8
.globl fputs_unlocked_2_2_5
.type fputs_unlocked_2_2_5, %function
.symver fputs_unlocked_2_2_5, fputs_unlocked@@GLIBC_2.2.5, remove
fputs_unlocked_2_2_5: .quad 0
.balign 8
.globl _IO_fgets_2_2_5
.type _IO_fgets_2_2_5, %function
.symver _IO_fgets_2_2_5, _IO_fgets@@GLIBC_2.2.5, remove
_IO_fgets_2_2_5: .quad 0
.balign 8
.globl rtime_2_2_5
.type rtime_2_2_5, %function
.symver rtime_2_2_5, rtime@@GLIBC_2.2.5, remove
rtime_2_2_5: .quad 0
.balign 8
.globl __fgets_unlocked_chk_2_4
.type __fgets_unlocked_chk_2_4, %function
.symver __fgets_unlocked_chk_2_4, __fgets_unlocked_chk@@GLIBC_2.4, remove
__fgets_unlocked_chk_2_4: .quad 0
.balign 8
.globl __nanosleep_2_2_6
.type __nanosleep_2_2_6, %function
.symver __nanosleep_2_2_6, __nanosleep@@GLIBC_2.2.6, remove
__nanosleep_2_2_6: .quad 0
.balign 8
.globl syslog_2_2_5
.type syslog_2_2_5, %function
.symver syslog_2_2_5, syslog@@GLIBC_2.2.5, remove
syslog_2_2_5: .quad 0
.balign 8
.globl getgrgid_r_2_2_5
.type getgrgid_r_2_2_5, %function
.symver getgrgid_r_2_2_5, getgrgid_r@@GLIBC_2.2.5, remove
getgrgid_r_2_2_5: .quad 0
.balign 8
.globl ether_line_2_2_5
.type ether_line_2_2_5, %function
.symver ether_line_2_2_5, ether_line@@GLIBC_2.2.5, remove
ether_line_2_2_5: .quad 0
.balign 8
.globl getaliasbyname_r_2_2_5
.type getaliasbyname_r_2_2_5, %function
.symver getaliasbyname_r_2_2_5, getaliasbyname_r@@GLIBC_2.2.5, remove
getaliasbyname_r_2_2_5: .quad 0
.balign 8
.globl mrand48_2_2_5
.type mrand48_2_2_5, %function
.symver mrand48_2_2_5, mrand48@@GLIBC_2.2.5, remove
mrand48_2_2_5: .quad 0
.balign 8
.globl isalpha_l_2_3
.type isalpha_l_2_3, %function
.symver isalpha_l_2_3, isalpha_l@@GLIBC_2.3, remove
isalpha_l_2_3: .quad 0
.balign 8
.globl insque_2_2_5
.type insque_2_2_5, %function
.symver insque_2_2_5, insque@@GLIBC_2.2.5, remove
insque_2_2_5: .quad 0
.balign 8
.globl sockatmark_2_2_5
.type sockatmark_2_2_5, %function
.symver sockatmark_2_2_5, sockatmark@@GLIBC_2.2.5, remove
sockatmark_2_2_5: .quad 0
.balign 8
.globl fgetwc_unlocked_2_2_5
.type fgetwc_unlocked_2_2_5, %function
.symver fgetwc_unlocked_2_2_5, fgetwc_unlocked@@GLIBC_2.2.5, remove
fgetwc_unlocked_2_2_5: .quad 0
.balign 8
.globl mallopt_2_2_5
.type mallopt_2_2_5, %function
.symver mallopt_2_2_5, mallopt@@GLIBC_2.2.5, remove
mallopt_2_2_5: .quad 0
.balign 8
.globl mkostemp_2_7
.type mkostemp_2_7, %function
.symver mkostemp_2_7, mkostemp@@GLIBC_2.7, remove
mkostemp_2_7: .quad 0
.balign 8
.globl link_2_2_5
.type link_2_2_5, %function
.symver link_2_2_5, link@@GLIBC_2.2.5, remove
link_2_2_5: .quad 0
.balign 8
.globl rmdir_2_2_5
.type rmdir_2_2_5, %function
.symver rmdir_2_2_5, rmdir@@GLIBC_2.2.5, remove
rmdir_2_2_5: .quad 0
.balign 8
.globl fts_children_2_2_5
.type fts_children_2_2_5, %function
.symver fts_children_2_2_5, fts_children@@GLIBC_2.2.5, remove
fts_children_2_2_5: .quad 0
.balign 8
.globl __printf_fp_2_2_5
.type __printf_fp_2_2_5, %function
.symver __printf_fp_2_2_5, __printf_fp@@GLIBC_2.2.5, remove
__printf_fp_2_2_5: .quad 0
.balign 8
.globl strtol_l_2_3
.type strtol_l_2_3, %function
.symver strtol_l_2_3, strtol_l@@GLIBC_2.3, remove
strtol_l_2_3: .quad 0
.balign 8
.globl __ptsname_r_chk_2_4
.type __ptsname_r_chk_2_4, %function
.symver __ptsname_r_chk_2_4, __ptsname_r_chk@@GLIBC_2.4, remove
__ptsname_r_chk_2_4: .quad 0
.balign 8
.globl geteuid_2_2_5
.type geteuid_2_2_5, %function
.symver geteuid_2_2_5, geteuid@@GLIBC_2.2.5, remove
geteuid_2_2_5: .quad 0
.balign 8
.globl __fgets_chk_2_4
.type __fgets_chk_2_4, %function
.symver __fgets_chk_2_4, __fgets_chk@@GLIBC_2.4, remove
__fgets_chk_2_4: .quad 0
.balign 8
.globl __isoc99_vswscanf_2_7
.type __isoc99_vswscanf_2_7, %function
.symver __isoc99_vswscanf_2_7, __isoc99_vswscanf@@GLIBC_2.7, remove
__isoc99_vswscanf_2_7: .quad 0
.balign 8
.globl xdr_u_int_2_2_5
.type xdr_u_int_2_2_5, %function
.symver xdr_u_int_2_2_5, xdr_u_int@@GLIBC_2.2.5, remove
xdr_u_int_2_2_5: .quad 0
.balign 8
.globl isinfl_2_2_5
.type isinfl_2_2_5, %function
.symver isinfl_2_2_5, isinfl@@GLIBC_2.2.5, remove
isinfl_2_2_5: .quad 0
.balign 8
.globl __ispunct_l_2_2_5
.type __ispunct_l_2_2_5, %function
.symver __ispunct_l_2_2_5, __ispunct_l@@GLIBC_2.2.5, remove
__ispunct_l_2_2_5: .quad 0
.balign 8
.globl bcmp_2_2_5
.type bcmp_2_2_5, %function
.symver bcmp_2_2_5, bcmp@@GLIBC_2.2.5, remove
bcmp_2_2_5: .quad 0
.balign 8
.globl getusershell_2_2_5
.type getusershell_2_2_5, %function
.symver getusershell_2_2_5, getusershell@@GLIBC_2.2.5, remove
getusershell_2_2_5: .quad 0
.balign 8
.globl setuid_2_2_5
.type setuid_2_2_5, %function
.symver setuid_2_2_5, setuid@@GLIBC_2.2.5, remove
setuid_2_2_5: .quad 0
.balign 8
.globl cbc_crypt_2_2_5
.type cbc_crypt_2_2_5, %function
.symver cbc_crypt_2_2_5, cbc_crypt@@GLIBC_2.2.5, remove
cbc_crypt_2_2_5: .quad 0
.balign 8
.globl _IO_default_finish_2_2_5
.type _IO_default_finish_2_2_5, %function
.symver _IO_default_finish_2_2_5, _IO_default_finish@@GLIBC_2.2.5, remove
_IO_default_finish_2_2_5: .quad 0
.balign 8
.globl imaxdiv_2_2_5
.type imaxdiv_2_2_5, %function
.symver imaxdiv_2_2_5, imaxdiv@@GLIBC_2.2.5, remove
imaxdiv_2_2_5: .quad 0
.balign 8
.globl getgid_2_2_5
.type getgid_2_2_5, %function
.symver getgid_2_2_5, getgid@@GLIBC_2.2.5, remove
getgid_2_2_5: .quad 0
.balign 8
.globl __backtrace_symbols_2_2_5
.type __backtrace_symbols_2_2_5, %function
.symver __backtrace_symbols_2_2_5, __backtrace_symbols@@GLIBC_2.2.5, remove
__backtrace_symbols_2_2_5: .quad 0
.balign 8
.globl __sigaddset_2_2_5
.type __sigaddset_2_2_5, %function
.symver __sigaddset_2_2_5, __sigaddset@@GLIBC_2.2.5, remove
__sigaddset_2_2_5: .quad 0
.balign 8
.globl getnetgrent_2_2_5
.type getnetgrent_2_2_5, %function
.symver getnetgrent_2_2_5, getnetgrent@@GLIBC_2.2.5, remove
getnetgrent_2_2_5: .quad 0
.balign 8
.globl __wuflow_2_2_5
.type __wuflow_2_2_5, %function
.symver __wuflow_2_2_5, __wuflow@@GLIBC_2.2.5, remove
__wuflow_2_2_5: .quad 0
.balign 8
.globl step_2_2_5
.type step_2_2_5, %function
.symver step_2_2_5, step@@GLIBC_2.2.5, remove
step_2_2_5: .quad 0
.balign 8
.globl readdir_2_2_5
.type readdir_2_2_5, %function
.symver readdir_2_2_5, readdir@@GLIBC_2.2.5, remove
readdir_2_2_5: .quad 0
.balign 8
.globl qfcvt_2_2_5
.type qfcvt_2_2_5, %function
.symver qfcvt_2_2_5, qfcvt@@GLIBC_2.2.5, remove
qfcvt_2_2_5: .quad 0
.balign 8
.globl sigsetmask_2_2_5
.type sigsetmask_2_2_5, %function
.symver sigsetmask_2_2_5, sigsetmask@@GLIBC_2.2.5, remove
sigsetmask_2_2_5: .quad 0
.balign 8
.globl exit_2_2_5
.type exit_2_2_5, %function
.symver exit_2_2_5, exit@@GLIBC_2.2.5, remove
exit_2_2_5: .quad 0
.balign 8
.globl xdr_uint8_t_2_2_5
.type xdr_uint8_t_2_2_5, %function
.symver xdr_uint8_t_2_2_5, xdr_uint8_t@@GLIBC_2.2.5, remove
xdr_uint8_t_2_2_5: .quad 0
.balign 8
.globl printf_size_info_2_2_5
.type printf_size_info_2_2_5, %function
.symver printf_size_info_2_2_5, printf_size_info@@GLIBC_2.2.5, remove
printf_size_info_2_2_5: .quad 0
.balign 8
.globl _obstack_free_2_2_5
.type _obstack_free_2_2_5, %function
.symver _obstack_free_2_2_5, _obstack_free@@GLIBC_2.2.5, remove
_obstack_free_2_2_5: .quad 0
.balign 8
.globl setxattr_2_3
.type setxattr_2_3, %function
.symver setxattr_2_3, setxattr@@GLIBC_2.3, remove
setxattr_2_3: .quad 0
.balign 8
.globl qsort_2_2_5
.type qsort_2_2_5, %function
.symver qsort_2_2_5, qsort@@GLIBC_2.2.5, remove
qsort_2_2_5: .quad 0
.balign 8
.globl getnetbyaddr_r_2_2_5
.type getnetbyaddr_r_2_2_5, %function
.symver getnetbyaddr_r_2_2_5, getnetbyaddr_r@@GLIBC_2.2.5, remove
getnetbyaddr_r_2_2_5: .quad 0
.balign 8
.globl personality_2_2_5
.type personality_2_2_5, %function
.symver personality_2_2_5, personality@@GLIBC_2.2.5, remove
personality_2_2_5: .quad 0
.balign 8
.globl getnetbyname_2_2_5
.type getnetbyname_2_2_5, %function
.symver getnetbyname_2_2_5, getnetbyname@@GLIBC_2.2.5, remove
getnetbyname_2_2_5: .quad 0
.balign 8
.globl qsort_r_2_8
.type qsort_r_2_8, %function
.symver qsort_r_2_8, qsort_r@@GLIBC_2.8, remove
qsort_r_2_8: .quad 0
.balign 8
.globl sgetsgent_2_10
.type sgetsgent_2_10, %function
.symver sgetsgent_2_10, sgetsgent@@GLIBC_2.10, remove
sgetsgent_2_10: .quad 0
.balign 8
.globl __sbrk_2_2_5
.type __sbrk_2_2_5, %function
.symver __sbrk_2_2_5, __sbrk@@GLIBC_2.2.5, remove
__sbrk_2_2_5: .quad 0
.balign 8
.globl vasprintf_2_2_5
.type vasprintf_2_2_5, %function
.symver vasprintf_2_2_5, vasprintf@@GLIBC_2.2.5, remove
vasprintf_2_2_5: .quad 0
.balign 8
.globl __strndup_2_2_5
.type __strndup_2_2_5, %function
.symver __strndup_2_2_5, __strndup@@GLIBC_2.2.5, remove
__strndup_2_2_5: .quad 0
.balign 8
.globl strspn_2_2_5
.type strspn_2_2_5, %function
.symver strspn_2_2_5, strspn@@GLIBC_2.2.5, remove
strspn_2_2_5: .quad 0
.balign 8
.globl __stpcpy_small_2_2_5
.type __stpcpy_small_2_2_5, %function
.symver __stpcpy_small_2_2_5, __stpcpy_small@@GLIBC_2.2.5, remove
__stpcpy_small_2_2_5: .quad 0
.balign 8
.globl __openat64_2_2_7
.type __openat64_2_2_7, %function
.symver __openat64_2_2_7, __openat64_2@@GLIBC_2.7, remove
__openat64_2_2_7: .quad 0
.balign 8
.globl ecvt_2_2_5
.type ecvt_2_2_5, %function
.symver ecvt_2_2_5, ecvt@@GLIBC_2.2.5, remove
ecvt_2_2_5: .quad 0
.balign 8
.globl __realpath_chk_2_4
.type __realpath_chk_2_4, %function
.symver __realpath_chk_2_4, __realpath_chk@@GLIBC_2.4, remove
__realpath_chk_2_4: .quad 0
.balign 8
.globl clock_getcpuclockid_2_17
.type clock_getcpuclockid_2_17, %function
.symver clock_getcpuclockid_2_17, clock_getcpuclockid@@GLIBC_2.17, remove
clock_getcpuclockid_2_17: .quad 0
.balign 8
.globl sched_getcpu_2_6
.type sched_getcpu_2_6, %function
.symver sched_getcpu_2_6, sched_getcpu@@GLIBC_2.6, remove
sched_getcpu_2_6: .quad 0
.balign 8
.globl __mempcpy_2_2_5
.type __mempcpy_2_2_5, %function
.symver __mempcpy_2_2_5, __mempcpy@@GLIBC_2.2.5, remove
__mempcpy_2_2_5: .quad 0
.balign 8
.globl wmemset_2_2_5
.type wmemset_2_2_5, %function
.symver wmemset_2_2_5, wmemset@@GLIBC_2.2.5, remove
wmemset_2_2_5: .quad 0
.balign 8
.globl close_2_2_5
.type close_2_2_5, %function
.symver close_2_2_5, close@@GLIBC_2.2.5, remove
close_2_2_5: .quad 0
.balign 8
.globl lchmod_2_3_2
.type lchmod_2_3_2, %function
.symver lchmod_2_3_2, lchmod@@GLIBC_2.3.2, remove
lchmod_2_3_2: .quad 0
.balign 8
.globl fgetxattr_2_3
.type fgetxattr_2_3, %function
.symver fgetxattr_2_3, fgetxattr@@GLIBC_2.3, remove
fgetxattr_2_3: .quad 0
.balign 8
.globl system_2_2_5
.type system_2_2_5, %function
.symver system_2_2_5, system@@GLIBC_2.2.5, remove
system_2_2_5: .quad 0
.balign 8
.globl fwrite_unlocked_2_2_5
.type fwrite_unlocked_2_2_5, %function
.symver fwrite_unlocked_2_2_5, fwrite_unlocked@@GLIBC_2.2.5, remove
fwrite_unlocked_2_2_5: .quad 0
.balign 8
.globl _IO_unsave_wmarkers_2_2_5
.type _IO_unsave_wmarkers_2_2_5, %function
.symver _IO_unsave_wmarkers_2_2_5, _IO_unsave_wmarkers@@GLIBC_2.2.5, remove
_IO_unsave_wmarkers_2_2_5: .quad 0
.balign 8
.globl timerfd_gettime_2_8
.type timerfd_gettime_2_8, %function
.symver timerfd_gettime_2_8, timerfd_gettime@@GLIBC_2.8, remove
timerfd_gettime_2_8: .quad 0
.balign 8
.globl sysconf_2_2_5
.type sysconf_2_2_5, %function
.symver sysconf_2_2_5, sysconf@@GLIBC_2.2.5, remove
sysconf_2_2_5: .quad 0
.balign 8
.globl qecvt_r_2_2_5
.type qecvt_r_2_2_5, %function
.symver qecvt_r_2_2_5, qecvt_r@@GLIBC_2.2.5, remove
qecvt_r_2_2_5: .quad 0
.balign 8
.globl strrchr_2_2_5
.type strrchr_2_2_5, %function
.symver strrchr_2_2_5, strrchr@@GLIBC_2.2.5, remove
strrchr_2_2_5: .quad 0
.balign 8
.globl authdes_pk_create_2_2_5
.type authdes_pk_create_2_2_5, %function
.symver authdes_pk_create_2_2_5, authdes_pk_create@@GLIBC_2.2.5, remove
authdes_pk_create_2_2_5: .quad 0
.balign 8
.globl __gettimeofday_2_2_5
.type __gettimeofday_2_2_5, %function
.symver __gettimeofday_2_2_5, __gettimeofday@@GLIBC_2.2.5, remove
__gettimeofday_2_2_5: .quad 0
.balign 8
.globl mcheck_2_2_5
.type mcheck_2_2_5, %function
.symver mcheck_2_2_5, mcheck@@GLIBC_2.2.5, remove
mcheck_2_2_5: .quad 0
.balign 8
.globl _IO_file_init_2_2_5
.type _IO_file_init_2_2_5, %function
.symver _IO_file_init_2_2_5, _IO_file_init@@GLIBC_2.2.5, remove
_IO_file_init_2_2_5: .quad 0
.balign 8
.globl re_search_2_2_2_5
.type re_search_2_2_2_5, %function
.symver re_search_2_2_2_5, re_search_2@@GLIBC_2.2.5, remove
re_search_2_2_2_5: .quad 0
.balign 8
.globl strtoimax_2_2_5
.type strtoimax_2_2_5, %function
.symver strtoimax_2_2_5, strtoimax@@GLIBC_2.2.5, remove
strtoimax_2_2_5: .quad 0
.balign 8
.globl ether_aton_r_2_2_5
.type ether_aton_r_2_2_5, %function
.symver ether_aton_r_2_2_5, ether_aton_r@@GLIBC_2.2.5, remove
ether_aton_r_2_2_5: .quad 0
.balign 8
.globl _IO_remove_marker_2_2_5
.type _IO_remove_marker_2_2_5, %function
.symver _IO_remove_marker_2_2_5, _IO_remove_marker@@GLIBC_2.2.5, remove
_IO_remove_marker_2_2_5: .quad 0
.balign 8
.globl __wait_2_2_5
.type __wait_2_2_5, %function
.symver __wait_2_2_5, __wait@@GLIBC_2.2.5, remove
__wait_2_2_5: .quad 0
.balign 8
.globl getchar_2_2_5
.type getchar_2_2_5, %function
.symver getchar_2_2_5, getchar@@GLIBC_2.2.5, remove
getchar_2_2_5: .quad 0
.balign 8
.globl tcgetpgrp_2_2_5
.type tcgetpgrp_2_2_5, %function
.symver tcgetpgrp_2_2_5, tcgetpgrp@@GLIBC_2.2.5, remove
tcgetpgrp_2_2_5: .quad 0
.balign 8
.globl wctob_2_2_5
.type wctob_2_2_5, %function
.symver wctob_2_2_5, wctob@@GLIBC_2.2.5, remove
wctob_2_2_5: .quad 0
.balign 8
.globl getgrent_2_2_5
.type getgrent_2_2_5, %function
.symver getgrent_2_2_5, getgrent@@GLIBC_2.2.5, remove
getgrent_2_2_5: .quad 0
.balign 8
.globl setpgrp_2_2_5
.type setpgrp_2_2_5, %function
.symver setpgrp_2_2_5, setpgrp@@GLIBC_2.2.5, remove
setpgrp_2_2_5: .quad 0
.balign 8
.globl __isdigit_l_2_2_5
.type __isdigit_l_2_2_5, %function
.symver __isdigit_l_2_2_5, __isdigit_l@@GLIBC_2.2.5, remove
__isdigit_l_2_2_5: .quad 0
.balign 8
.globl __pread64_chk_2_4
.type __pread64_chk_2_4, %function
.symver __pread64_chk_2_4, __pread64_chk@@GLIBC_2.4, remove
__pread64_chk_2_4: .quad 0
.balign 8
.globl flockfile_2_2_5
.type flockfile_2_2_5, %function
.symver flockfile_2_2_5, flockfile@@GLIBC_2.2.5, remove
flockfile_2_2_5: .quad 0
.balign 8
.globl getnetent_2_2_5
.type getnetent_2_2_5, %function
.symver getnetent_2_2_5, getnetent@@GLIBC_2.2.5, remove
getnetent_2_2_5: .quad 0
.balign 8
.globl __wcstold_internal_2_2_5
.type __wcstold_internal_2_2_5, %function
.symver __wcstold_internal_2_2_5, __wcstold_internal@@GLIBC_2.2.5, remove
__wcstold_internal_2_2_5: .quad 0
.balign 8
.globl re_match_2_2_5
.type re_match_2_2_5, %function
.symver re_match_2_2_5, re_match@@GLIBC_2.2.5, remove
re_match_2_2_5: .quad 0
.balign 8
.globl socketpair_2_2_5
.type socketpair_2_2_5, %function
.symver socketpair_2_2_5, socketpair@@GLIBC_2.2.5, remove
socketpair_2_2_5: .quad 0
.balign 8
.globl vswprintf_2_2_5
.type vswprintf_2_2_5, %function
.symver vswprintf_2_2_5, vswprintf@@GLIBC_2.2.5, remove
vswprintf_2_2_5: .quad 0
.balign 8
.globl ether_ntohost_2_2_5
.type ether_ntohost_2_2_5, %function
.symver ether_ntohost_2_2_5, ether_ntohost@@GLIBC_2.2.5, remove
ether_ntohost_2_2_5: .quad 0
.balign 8
.globl __isoc99_vwscanf_2_7
.type __isoc99_vwscanf_2_7, %function
.symver __isoc99_vwscanf_2_7, __isoc99_vwscanf@@GLIBC_2.7, remove
__isoc99_vwscanf_2_7: .quad 0
.balign 8
.globl putc_unlocked_2_2_5
.type putc_unlocked_2_2_5, %function
.symver putc_unlocked_2_2_5, putc_unlocked@@GLIBC_2.2.5, remove
putc_unlocked_2_2_5: .quad 0
.balign 8
.globl xdr_pmaplist_2_2_5
.type xdr_pmaplist_2_2_5, %function
.symver xdr_pmaplist_2_2_5, xdr_pmaplist@@GLIBC_2.2.5, remove
xdr_pmaplist_2_2_5: .quad 0
.balign 8
.globl epoll_wait_2_3_2
.type epoll_wait_2_3_2, %function
.symver epoll_wait_2_3_2, epoll_wait@@GLIBC_2.3.2, remove
epoll_wait_2_3_2: .quad 0
.balign 8
.globl lcong48_2_2_5
.type lcong48_2_2_5, %function
.symver lcong48_2_2_5, lcong48@@GLIBC_2.2.5, remove
lcong48_2_2_5: .quad 0
.balign 8
.globl _IO_seekmark_2_2_5
.type _IO_seekmark_2_2_5, %function
.symver _IO_seekmark_2_2_5, _IO_seekmark@@GLIBC_2.2.5, remove
_IO_seekmark_2_2_5: .quad 0
.balign 8
.globl epoll_pwait_2_6
.type epoll_pwait_2_6, %function
.symver epoll_pwait_2_6, epoll_pwait@@GLIBC_2.6, remove
epoll_pwait_2_6: .quad 0
.balign 8
.globl svcudp_enablecache_2_2_5
.type svcudp_enablecache_2_2_5, %function
.symver svcudp_enablecache_2_2_5, svcudp_enablecache@@GLIBC_2.2.5, remove
svcudp_enablecache_2_2_5: .quad 0
.balign 8
.globl envz_strip_2_2_5
.type envz_strip_2_2_5, %function
.symver envz_strip_2_2_5, envz_strip@@GLIBC_2.2.5, remove
envz_strip_2_2_5: .quad 0
.balign 8
.globl __syslog_chk_2_4
.type __syslog_chk_2_4, %function
.symver __syslog_chk_2_4, __syslog_chk@@GLIBC_2.4, remove
__syslog_chk_2_4: .quad 0
.balign 8
.globl __duplocale_2_2_5
.type __duplocale_2_2_5, %function
.symver __duplocale_2_2_5, __duplocale@@GLIBC_2.2.5, remove
__duplocale_2_2_5: .quad 0
.balign 8
.globl getservent_2_2_5
.type getservent_2_2_5, %function
.symver getservent_2_2_5, getservent@@GLIBC_2.2.5, remove
getservent_2_2_5: .quad 0
.balign 8
.globl putwchar_2_2_5
.type putwchar_2_2_5, %function
.symver putwchar_2_2_5, putwchar@@GLIBC_2.2.5, remove
putwchar_2_2_5: .quad 0
.balign 8
.globl strstr_2_2_5
.type strstr_2_2_5, %function
.symver strstr_2_2_5, strstr@@GLIBC_2.2.5, remove
strstr_2_2_5: .quad 0
.balign 8
.globl getc_2_2_5
.type getc_2_2_5, %function
.symver getc_2_2_5, getc@@GLIBC_2.2.5, remove
getc_2_2_5: .quad 0
.balign 8
.globl __ctype_tolower_loc_2_3
.type __ctype_tolower_loc_2_3, %function
.symver __ctype_tolower_loc_2_3, __ctype_tolower_loc@@GLIBC_2.3, remove
__ctype_tolower_loc_2_3: .quad 0
.balign 8
.globl __getcwd_chk_2_4
.type __getcwd_chk_2_4, %function
.symver __getcwd_chk_2_4, __getcwd_chk@@GLIBC_2.4, remove
__getcwd_chk_2_4: .quad 0
.balign 8
.globl malloc_stats_2_2_5
.type malloc_stats_2_2_5, %function
.symver malloc_stats_2_2_5, malloc_stats@@GLIBC_2.2.5, remove
malloc_stats_2_2_5: .quad 0
.balign 8
.globl __lseek_2_2_5
.type __lseek_2_2_5, %function
.symver __lseek_2_2_5, __lseek@@GLIBC_2.2.5, remove
__lseek_2_2_5: .quad 0
.balign 8
.globl gethostbyaddr_r_2_2_5
.type gethostbyaddr_r_2_2_5, %function
.symver gethostbyaddr_r_2_2_5, gethostbyaddr_r@@GLIBC_2.2.5, remove
gethostbyaddr_r_2_2_5: .quad 0
.balign 8
.globl _IO_vfprintf_2_2_5
.type _IO_vfprintf_2_2_5, %function
.symver _IO_vfprintf_2_2_5, _IO_vfprintf@@GLIBC_2.2.5, remove
_IO_vfprintf_2_2_5: .quad 0
.balign 8
.globl __uselocale_2_3
.type __uselocale_2_3, %function
.symver __uselocale_2_3, __uselocale@@GLIBC_2.3, remove
__uselocale_2_3: .quad 0
.balign 8
.globl __iswpunct_l_2_2_5
.type __iswpunct_l_2_2_5, %function
.symver __iswpunct_l_2_2_5, __iswpunct_l@@GLIBC_2.2.5, remove
__iswpunct_l_2_2_5: .quad 0
.balign 8
.globl __libc_pvalloc_2_2_5
.type __libc_pvalloc_2_2_5, %function
.symver __libc_pvalloc_2_2_5, __libc_pvalloc@@GLIBC_2.2.5, remove
__libc_pvalloc_2_2_5: .quad 0
.balign 8
.globl __sigdelset_2_2_5
.type __sigdelset_2_2_5, %function
.symver __sigdelset_2_2_5, __sigdelset@@GLIBC_2.2.5, remove
__sigdelset_2_2_5: .quad 0
.balign 8
.globl chroot_2_2_5
.type chroot_2_2_5, %function
.symver chroot_2_2_5, chroot@@GLIBC_2.2.5, remove
chroot_2_2_5: .quad 0
.balign 8
.globl mkfifo_2_2_5
.type mkfifo_2_2_5, %function
.symver mkfifo_2_2_5, mkfifo@@GLIBC_2.2.5, remove
mkfifo_2_2_5: .quad 0
.balign 8
.globl re_set_syntax_2_2_5
.type re_set_syntax_2_2_5, %function
.symver re_set_syntax_2_2_5, re_set_syntax@@GLIBC_2.2.5, remove
re_set_syntax_2_2_5: .quad 0
.balign 8
.globl _IO_wfile_xsputn_2_2_5
.type _IO_wfile_xsputn_2_2_5, %function
.symver _IO_wfile_xsputn_2_2_5, _IO_wfile_xsputn@@GLIBC_2.2.5, remove
_IO_wfile_xsputn_2_2_5: .quad 0
.balign 8
.globl __cxa_at_quick_exit_2_10
.type __cxa_at_quick_exit_2_10, %function
.symver __cxa_at_quick_exit_2_10, __cxa_at_quick_exit@@GLIBC_2.10, remove
__cxa_at_quick_exit_2_10: .quad 0
.balign 8
.globl sched_rr_get_interval_2_2_5
.type sched_rr_get_interval_2_2_5, %function
.symver sched_rr_get_interval_2_2_5, sched_rr_get_interval@@GLIBC_2.2.5, remove
sched_rr_get_interval_2_2_5: .quad 0
.balign 8
.globl __strcasestr_2_2_5
.type __strcasestr_2_2_5, %function
.symver __strcasestr_2_2_5, __strcasestr@@GLIBC_2.2.5, remove
__strcasestr_2_2_5: .quad 0
.balign 8
.globl __fxstatat64_2_4
.type __fxstatat64_2_4, %function
.symver __fxstatat64_2_4, __fxstatat64@@GLIBC_2.4, remove
__fxstatat64_2_4: .quad 0
.balign 8
.globl __vswprintf_chk_2_4
.type __vswprintf_chk_2_4, %function
.symver __vswprintf_chk_2_4, __vswprintf_chk@@GLIBC_2.4, remove
__vswprintf_chk_2_4: .quad 0
.balign 8
.globl __ctype_toupper_loc_2_3
.type __ctype_toupper_loc_2_3, %function
.symver __ctype_toupper_loc_2_3, __ctype_toupper_loc@@GLIBC_2.3, remove
__ctype_toupper_loc_2_3: .quad 0
.balign 8
.globl __strtof_internal_2_2_5
.type __strtof_internal_2_2_5, %function
.symver __strtof_internal_2_2_5, __strtof_internal@@GLIBC_2.2.5, remove
__strtof_internal_2_2_5: .quad 0
.balign 8
.globl __libc_sa_len_2_2_5
.type __libc_sa_len_2_2_5, %function
.symver __libc_sa_len_2_2_5, __libc_sa_len@@GLIBC_2.2.5, remove
__libc_sa_len_2_2_5: .quad 0
.balign 8
.globl waitpid_2_2_5
.type waitpid_2_2_5, %function
.symver waitpid_2_2_5, waitpid@@GLIBC_2.2.5, remove
waitpid_2_2_5: .quad 0
.balign 8
.globl __stpncpy_chk_2_4
.type __stpncpy_chk_2_4, %function
.symver __stpncpy_chk_2_4, __stpncpy_chk@@GLIBC_2.4, remove
__stpncpy_chk_2_4: .quad 0
.balign 8
.globl utmpxname_2_2_5
.type utmpxname_2_2_5, %function
.symver utmpxname_2_2_5, utmpxname@@GLIBC_2.2.5, remove
utmpxname_2_2_5: .quad 0
.balign 8
.globl cfmakeraw_2_2_5
.type cfmakeraw_2_2_5, %function
.symver cfmakeraw_2_2_5, cfmakeraw@@GLIBC_2.2.5, remove
cfmakeraw_2_2_5: .quad 0
.balign 8
.globl atoll_2_2_5
.type atoll_2_2_5, %function
.symver atoll_2_2_5, atoll@@GLIBC_2.2.5, remove
atoll_2_2_5: .quad 0
.balign 8
.globl inotify_rm_watch_2_4
.type inotify_rm_watch_2_4, %function
.symver inotify_rm_watch_2_4, inotify_rm_watch@@GLIBC_2.4, remove
inotify_rm_watch_2_4: .quad 0
.balign 8
.globl __libc_current_sigrtmin_2_2_5
.type __libc_current_sigrtmin_2_2_5, %function
.symver __libc_current_sigrtmin_2_2_5, __libc_current_sigrtmin@@GLIBC_2.2.5, remove
__libc_current_sigrtmin_2_2_5: .quad 0
.balign 8
.globl getutxent_2_2_5
.type getutxent_2_2_5, %function
.symver getutxent_2_2_5, getutxent@@GLIBC_2.2.5, remove
getutxent_2_2_5: .quad 0
.balign 8
.globl key_encryptsession_pk_2_2_5
.type key_encryptsession_pk_2_2_5, %function
.symver key_encryptsession_pk_2_2_5, key_encryptsession_pk@@GLIBC_2.2.5, remove
key_encryptsession_pk_2_2_5: .quad 0
.balign 8
.globl setgid_2_2_5
.type setgid_2_2_5, %function
.symver setgid_2_2_5, setgid@@GLIBC_2.2.5, remove
setgid_2_2_5: .quad 0
.balign 8
.globl _IO_file_xsputn_2_2_5
.type _IO_file_xsputn_2_2_5, %function
.symver _IO_file_xsputn_2_2_5, _IO_file_xsputn@@GLIBC_2.2.5, remove
_IO_file_xsputn_2_2_5: .quad 0
.balign 8
.globl posix_fadvise_2_2_5
.type posix_fadvise_2_2_5, %function
.symver posix_fadvise_2_2_5, posix_fadvise@@GLIBC_2.2.5, remove
posix_fadvise_2_2_5: .quad 0
.balign 8
.globl msgctl_2_2_5
.type msgctl_2_2_5, %function
.symver msgctl_2_2_5, msgctl@@GLIBC_2.2.5, remove
msgctl_2_2_5: .quad 0
.balign 8
.globl __poll_2_2_5
.type __poll_2_2_5, %function
.symver __poll_2_2_5, __poll@@GLIBC_2.2.5, remove
__poll_2_2_5: .quad 0
.balign 8
.globl __vfork_2_2_5
.type __vfork_2_2_5, %function
.symver __vfork_2_2_5, __vfork@@GLIBC_2.2.5, remove
__vfork_2_2_5: .quad 0
.balign 8
.globl getrpcent_r_2_2_5
.type getrpcent_r_2_2_5, %function
.symver getrpcent_r_2_2_5, getrpcent_r@@GLIBC_2.2.5, remove
getrpcent_r_2_2_5: .quad 0
.balign 8
.globl ulckpwdf_2_2_5
.type ulckpwdf_2_2_5, %function
.symver ulckpwdf_2_2_5, ulckpwdf@@GLIBC_2.2.5, remove
ulckpwdf_2_2_5: .quad 0
.balign 8
.globl vsnprintf_2_2_5
.type vsnprintf_2_2_5, %function
.symver vsnprintf_2_2_5, vsnprintf@@GLIBC_2.2.5, remove
vsnprintf_2_2_5: .quad 0
.balign 8
.globl name_to_handle_at_2_14
.type name_to_handle_at_2_14, %function
.symver name_to_handle_at_2_14, name_to_handle_at@@GLIBC_2.14, remove
name_to_handle_at_2_14: .quad 0
.balign 8
.globl vwarnx_2_2_5
.type vwarnx_2_2_5, %function
.symver vwarnx_2_2_5, vwarnx@@GLIBC_2.2.5, remove
vwarnx_2_2_5: .quad 0
.balign 8
.globl _IO_default_xsgetn_2_2_5
.type _IO_default_xsgetn_2_2_5, %function
.symver _IO_default_xsgetn_2_2_5, _IO_default_xsgetn@@GLIBC_2.2.5, remove
_IO_default_xsgetn_2_2_5: .quad 0
.balign 8
.globl _IO_link_in_2_2_5
.type _IO_link_in_2_2_5, %function
.symver _IO_link_in_2_2_5, _IO_link_in@@GLIBC_2.2.5, remove
_IO_link_in_2_2_5: .quad 0
.balign 8
.globl xdr_uint64_t_2_2_5
.type xdr_uint64_t_2_2_5, %function
.symver xdr_uint64_t_2_2_5, xdr_uint64_t@@GLIBC_2.2.5, remove
xdr_uint64_t_2_2_5: .quad 0
.balign 8
.globl getpass_2_2_5
.type getpass_2_2_5, %function
.symver getpass_2_2_5, getpass@@GLIBC_2.2.5, remove
getpass_2_2_5: .quad 0
.balign 8
.globl svcerr_progvers_2_2_5
.type svcerr_progvers_2_2_5, %function
.symver svcerr_progvers_2_2_5, svcerr_progvers@@GLIBC_2.2.5, remove
svcerr_progvers_2_2_5: .quad 0
.balign 8
.globl rpmatch_2_2_5
.type rpmatch_2_2_5, %function
.symver rpmatch_2_2_5, rpmatch@@GLIBC_2.2.5, remove
rpmatch_2_2_5: .quad 0
.balign 8
.globl getpwent_2_2_5
.type getpwent_2_2_5, %function
.symver getpwent_2_2_5, getpwent@@GLIBC_2.2.5, remove
getpwent_2_2_5: .quad 0
.balign 8
.globl a64l_2_2_5
.type a64l_2_2_5, %function
.symver a64l_2_2_5, a64l@@GLIBC_2.2.5, remove
a64l_2_2_5: .quad 0
.balign 8
.globl sendmmsg_2_14
.type sendmmsg_2_14, %function
.symver sendmmsg_2_14, sendmmsg@@GLIBC_2.14, remove
sendmmsg_2_14: .quad 0
.balign 8
.globl isnanf_2_2_5
.type isnanf_2_2_5, %function
.symver isnanf_2_2_5, isnanf@@GLIBC_2.2.5, remove
isnanf_2_2_5: .quad 0
.balign 8
.globl aligned_alloc_2_16
.type aligned_alloc_2_16, %function
.symver aligned_alloc_2_16, aligned_alloc@@GLIBC_2.16, remove
aligned_alloc_2_16: .quad 0
.balign 8
.globl islower_l_2_3
.type islower_l_2_3, %function
.symver islower_l_2_3, islower_l@@GLIBC_2.3, remove
islower_l_2_3: .quad 0
.balign 8
.globl gtty_2_2_5
.type gtty_2_2_5, %function
.symver gtty_2_2_5, gtty@@GLIBC_2.2.5, remove
gtty_2_2_5: .quad 0
.balign 8
.globl getprotoent_r_2_2_5
.type getprotoent_r_2_2_5, %function
.symver getprotoent_r_2_2_5, getprotoent_r@@GLIBC_2.2.5, remove
getprotoent_r_2_2_5: .quad 0
.balign 8
.globl sigandset_2_2_5
.type sigandset_2_2_5, %function
.symver sigandset_2_2_5, sigandset@@GLIBC_2.2.5, remove
sigandset_2_2_5: .quad 0
.balign 8
.globl mkostemp64_2_7
.type mkostemp64_2_7, %function
.symver mkostemp64_2_7, mkostemp64@@GLIBC_2.7, remove
mkostemp64_2_7: .quad 0
.balign 8
.globl malloc_get_state_2_2_5
.type malloc_get_state_2_2_5, %function
.symver malloc_get_state_2_2_5, malloc_get_state@@GLIBC_2.2.5, remove
malloc_get_state_2_2_5: .quad 0
.balign 8
.globl finite_2_2_5
.type finite_2_2_5, %function
.symver finite_2_2_5, finite@@GLIBC_2.2.5, remove
finite_2_2_5: .quad 0
.balign 8
.globl getpwuid_2_2_5
.type getpwuid_2_2_5, %function
.symver getpwuid_2_2_5, getpwuid@@GLIBC_2.2.5, remove
getpwuid_2_2_5: .quad 0
.balign 8
.globl fstatfs64_2_2_5
.type fstatfs64_2_2_5, %function
.symver fstatfs64_2_2_5, fstatfs64@@GLIBC_2.2.5, remove
fstatfs64_2_2_5: .quad 0
.balign 8
.globl isnan_2_2_5
.type isnan_2_2_5, %function
.symver isnan_2_2_5, isnan@@GLIBC_2.2.5, remove
isnan_2_2_5: .quad 0
.balign 8
.globl __strcspn_c3_2_2_5
.type __strcspn_c3_2_2_5, %function
.symver __strcspn_c3_2_2_5, __strcspn_c3@@GLIBC_2.2.5, remove
__strcspn_c3_2_2_5: .quad 0
.balign 8
.globl tcdrain_2_2_5
.type tcdrain_2_2_5, %function
.symver tcdrain_2_2_5, tcdrain@@GLIBC_2.2.5, remove
tcdrain_2_2_5: .quad 0
.balign 8
.globl isspace_l_2_3
.type isspace_l_2_3, %function
.symver isspace_l_2_3, isspace_l@@GLIBC_2.3, remove
isspace_l_2_3: .quad 0
.balign 8
.globl inet_ntop_2_2_5
.type inet_ntop_2_2_5, %function
.symver inet_ntop_2_2_5, inet_ntop@@GLIBC_2.2.5, remove
inet_ntop_2_2_5: .quad 0
.balign 8
.globl mbrtowc_2_2_5
.type mbrtowc_2_2_5, %function
.symver mbrtowc_2_2_5, mbrtowc@@GLIBC_2.2.5, remove
mbrtowc_2_2_5: .quad 0
.balign 8
.globl gnu_get_libc_release_2_2_5
.type gnu_get_libc_release_2_2_5, %function
.symver gnu_get_libc_release_2_2_5, gnu_get_libc_release@@GLIBC_2.2.5, remove
gnu_get_libc_release_2_2_5: .quad 0
.balign 8
.globl wcscpy_2_2_5
.type wcscpy_2_2_5, %function
.symver wcscpy_2_2_5, wcscpy@@GLIBC_2.2.5, remove
wcscpy_2_2_5: .quad 0
.balign 8
.globl __finitef_2_2_5
.type __finitef_2_2_5, %function
.symver __finitef_2_2_5, __finitef@@GLIBC_2.2.5, remove
__finitef_2_2_5: .quad 0
.balign 8
.globl eventfd_read_2_7
.type eventfd_read_2_7, %function
.symver eventfd_read_2_7, eventfd_read@@GLIBC_2.7, remove
eventfd_read_2_7: .quad 0
.balign 8
.globl getutid_2_2_5
.type getutid_2_2_5, %function
.symver getutid_2_2_5, getutid@@GLIBC_2.2.5, remove
getutid_2_2_5: .quad 0
.balign 8
.globl iswdigit_l_2_3
.type iswdigit_l_2_3, %function
.symver iswdigit_l_2_3, iswdigit_l@@GLIBC_2.3, remove
iswdigit_l_2_3: .quad 0
.balign 8
.globl xdrmem_create_2_2_5
.type xdrmem_create_2_2_5, %function
.symver xdrmem_create_2_2_5, xdrmem_create@@GLIBC_2.2.5, remove
xdrmem_create_2_2_5: .quad 0
.balign 8
.globl __sched_cpucount_2_6
.type __sched_cpucount_2_6, %function
.symver __sched_cpucount_2_6, __sched_cpucount@@GLIBC_2.6, remove
__sched_cpucount_2_6: .quad 0
.balign 8
.globl wcstol_2_2_5
.type wcstol_2_2_5, %function
.symver wcstol_2_2_5, wcstol@@GLIBC_2.2.5, remove
wcstol_2_2_5: .quad 0
.balign 8
.globl mbsinit_2_2_5
.type mbsinit_2_2_5, %function
.symver mbsinit_2_2_5, mbsinit@@GLIBC_2.2.5, remove
mbsinit_2_2_5: .quad 0
.balign 8
.globl __newlocale_2_2_5
.type __newlocale_2_2_5, %function
.symver __newlocale_2_2_5, __newlocale@@GLIBC_2.2.5, remove
__newlocale_2_2_5: .quad 0
.balign 8
.globl ftrylockfile_2_2_5
.type ftrylockfile_2_2_5, %function
.symver ftrylockfile_2_2_5, ftrylockfile@@GLIBC_2.2.5, remove
ftrylockfile_2_2_5: .quad 0
.balign 8
.globl getwchar_2_2_5
.type getwchar_2_2_5, %function
.symver getwchar_2_2_5, getwchar@@GLIBC_2.2.5, remove
getwchar_2_2_5: .quad 0
.balign 8
.globl wcsxfrm_l_2_3
.type wcsxfrm_l_2_3, %function
.symver wcsxfrm_l_2_3, wcsxfrm_l@@GLIBC_2.3, remove
wcsxfrm_l_2_3: .quad 0
.balign 8
.globl inotify_add_watch_2_4
.type inotify_add_watch_2_4, %function
.symver inotify_add_watch_2_4, inotify_add_watch@@GLIBC_2.4, remove
inotify_add_watch_2_4: .quad 0
.balign 8
.globl xdr_replymsg_2_2_5
.type xdr_replymsg_2_2_5, %function
.symver xdr_replymsg_2_2_5, xdr_replymsg@@GLIBC_2.2.5, remove
xdr_replymsg_2_2_5: .quad 0
.balign 8
.globl inet6_opt_finish_2_5
.type inet6_opt_finish_2_5, %function
.symver inet6_opt_finish_2_5, inet6_opt_finish@@GLIBC_2.5, remove
inet6_opt_finish_2_5: .quad 0
.balign 8
.globl _IO_list_unlock_2_2_5
.type _IO_list_unlock_2_2_5, %function
.symver _IO_list_unlock_2_2_5, _IO_list_unlock@@GLIBC_2.2.5, remove
_IO_list_unlock_2_2_5: .quad 0
.balign 8
.globl getprotobynumber_r_2_2_5
.type getprotobynumber_r_2_2_5, %function
.symver getprotobynumber_r_2_2_5, getprotobynumber_r@@GLIBC_2.2.5, remove
getprotobynumber_r_2_2_5: .quad 0
.balign 8
.globl setlogin_2_2_5
.type setlogin_2_2_5, %function
.symver setlogin_2_2_5, setlogin@@GLIBC_2.2.5, remove
setlogin_2_2_5: .quad 0
.balign 8
.globl inet6_opt_init_2_5
.type inet6_opt_init_2_5, %function
.symver inet6_opt_init_2_5, inet6_opt_init@@GLIBC_2.5, remove
inet6_opt_init_2_5: .quad 0
.balign 8
.globl svc_getreq_poll_2_2_5
.type svc_getreq_poll_2_2_5, %function
.symver svc_getreq_poll_2_2_5, svc_getreq_poll@@GLIBC_2.2.5, remove
svc_getreq_poll_2_2_5: .quad 0
.balign 8
.globl __longjmp_chk_2_11
.type __longjmp_chk_2_11, %function
.symver __longjmp_chk_2_11, __longjmp_chk@@GLIBC_2.11, remove
__longjmp_chk_2_11: .quad 0
.balign 8
.globl fgetc_unlocked_2_2_5
.type fgetc_unlocked_2_2_5, %function
.symver fgetc_unlocked_2_2_5, fgetc_unlocked@@GLIBC_2.2.5, remove
fgetc_unlocked_2_2_5: .quad 0
.balign 8
.globl __sched_yield_2_2_5
.type __sched_yield_2_2_5, %function
.symver __sched_yield_2_2_5, __sched_yield@@GLIBC_2.2.5, remove
__sched_yield_2_2_5: .quad 0
.balign 8
.globl wctrans_l_2_3
.type wctrans_l_2_3, %function
.symver wctrans_l_2_3, wctrans_l@@GLIBC_2.3, remove
wctrans_l_2_3: .quad 0
.balign 8
.globl pclose_2_2_5
.type pclose_2_2_5, %function
.symver pclose_2_2_5, pclose@@GLIBC_2.2.5, remove
pclose_2_2_5: .quad 0
.balign 8
.globl argp_help_2_2_5
.type argp_help_2_2_5, %function
.symver argp_help_2_2_5, argp_help@@GLIBC_2.2.5, remove
argp_help_2_2_5: .quad 0
.balign 8
.globl xdr_des_block_2_2_5
.type xdr_des_block_2_2_5, %function
.symver xdr_des_block_2_2_5, xdr_des_block@@GLIBC_2.2.5, remove
xdr_des_block_2_2_5: .quad 0
.balign 8
.globl posix_memalign_2_2_5
.type posix_memalign_2_2_5, %function
.symver posix_memalign_2_2_5, posix_memalign@@GLIBC_2.2.5, remove
posix_memalign_2_2_5: .quad 0
.balign 8
.globl epoll_ctl_2_3_2
.type epoll_ctl_2_3_2, %function
.symver epoll_ctl_2_3_2, epoll_ctl@@GLIBC_2.3.2, remove
epoll_ctl_2_3_2: .quad 0
.balign 8
.globl getservent_r_2_2_5
.type getservent_r_2_2_5, %function
.symver getservent_r_2_2_5, getservent_r@@GLIBC_2.2.5, remove
getservent_r_2_2_5: .quad 0
.balign 8
.globl scanf_2_2_5
.type scanf_2_2_5, %function
.symver scanf_2_2_5, scanf@@GLIBC_2.2.5, remove
scanf_2_2_5: .quad 0
.balign 8
.globl getw_2_2_5
.type getw_2_2_5, %function
.symver getw_2_2_5, getw@@GLIBC_2.2.5, remove
getw_2_2_5: .quad 0
.balign 8
.globl iswlower_2_2_5
.type iswlower_2_2_5, %function
.symver iswlower_2_2_5, iswlower@@GLIBC_2.2.5, remove
iswlower_2_2_5: .quad 0
.balign 8
.globl textdomain_2_2_5
.type textdomain_2_2_5, %function
.symver textdomain_2_2_5, textdomain@@GLIBC_2.2.5, remove
textdomain_2_2_5: .quad 0
.balign 8
.globl strtoul_l_2_3
.type strtoul_l_2_3, %function
.symver strtoul_l_2_3, strtoul_l@@GLIBC_2.3, remove
strtoul_l_2_3: .quad 0
.balign 8
.globl syscall_2_2_5
.type syscall_2_2_5, %function
.symver syscall_2_2_5, syscall@@GLIBC_2.2.5, remove
syscall_2_2_5: .quad 0
.balign 8
.globl setpwent_2_2_5
.type setpwent_2_2_5, %function
.symver setpwent_2_2_5, setpwent@@GLIBC_2.2.5, remove
setpwent_2_2_5: .quad 0
.balign 8
.globl argz_stringify_2_2_5
.type argz_stringify_2_2_5, %function
.symver argz_stringify_2_2_5, argz_stringify@@GLIBC_2.2.5, remove
argz_stringify_2_2_5: .quad 0
.balign 8
.globl svcerr_auth_2_2_5
.type svcerr_auth_2_2_5, %function
.symver svcerr_auth_2_2_5, svcerr_auth@@GLIBC_2.2.5, remove
svcerr_auth_2_2_5: .quad 0
.balign 8
.globl mlock_2_2_5
.type mlock_2_2_5, %function
.symver mlock_2_2_5, mlock@@GLIBC_2.2.5, remove
mlock_2_2_5: .quad 0
.balign 8
.globl sched_get_priority_max_2_2_5
.type sched_get_priority_max_2_2_5, %function
.symver sched_get_priority_max_2_2_5, sched_get_priority_max@@GLIBC_2.2.5, remove
sched_get_priority_max_2_2_5: .quad 0
.balign 8
.globl getaddrinfo_2_2_5
.type getaddrinfo_2_2_5, %function
.symver getaddrinfo_2_2_5, getaddrinfo@@GLIBC_2.2.5, remove
getaddrinfo_2_2_5: .quad 0
.balign 8
.globl sync_2_2_5
.type sync_2_2_5, %function
.symver sync_2_2_5, sync@@GLIBC_2.2.5, remove
sync_2_2_5: .quad 0
.balign 8
.globl posix_spawnattr_setschedpolicy_2_2_5
.type posix_spawnattr_setschedpolicy_2_2_5, %function
.symver posix_spawnattr_setschedpolicy_2_2_5, posix_spawnattr_setschedpolicy@@GLIBC_2.2.5, remove
posix_spawnattr_setschedpolicy_2_2_5: .quad 0
.balign 8
.globl __flbf_2_2_5
.type __flbf_2_2_5, %function
.symver __flbf_2_2_5, __flbf@@GLIBC_2.2.5, remove
__flbf_2_2_5: .quad 0
.balign 8
.globl _obstack_newchunk_2_2_5
.type _obstack_newchunk_2_2_5, %function
.symver _obstack_newchunk_2_2_5, _obstack_newchunk@@GLIBC_2.2.5, remove
_obstack_newchunk_2_2_5: .quad 0
.balign 8
.globl swab_2_2_5
.type swab_2_2_5, %function
.symver swab_2_2_5, swab@@GLIBC_2.2.5, remove
swab_2_2_5: .quad 0
.balign 8
.globl vfscanf_2_2_5
.type vfscanf_2_2_5, %function
.symver vfscanf_2_2_5, vfscanf@@GLIBC_2.2.5, remove
vfscanf_2_2_5: .quad 0
.balign 8
.globl lseek_2_2_5
.type lseek_2_2_5, %function
.symver lseek_2_2_5, lseek@@GLIBC_2.2.5, remove
lseek_2_2_5: .quad 0
.balign 8
.globl _IO_ftell_2_2_5
.type _IO_ftell_2_2_5, %function
.symver _IO_ftell_2_2_5, _IO_ftell@@GLIBC_2.2.5, remove
_IO_ftell_2_2_5: .quad 0
.balign 8
.globl finitef_2_2_5
.type finitef_2_2_5, %function
.symver finitef_2_2_5, finitef@@GLIBC_2.2.5, remove
finitef_2_2_5: .quad 0
.balign 8
.globl wcsncmp_2_2_5
.type wcsncmp_2_2_5, %function
.symver wcsncmp_2_2_5, wcsncmp@@GLIBC_2.2.5, remove
wcsncmp_2_2_5: .quad 0
.balign 8
.globl __open_2_2_7
.type __open_2_2_7, %function
.symver __open_2_2_7, __open_2@@GLIBC_2.7, remove
__open_2_2_7: .quad 0
.balign 8
.globl fgetws_unlocked_2_2_5
.type fgetws_unlocked_2_2_5, %function
.symver fgetws_unlocked_2_2_5, fgetws_unlocked@@GLIBC_2.2.5, remove
fgetws_unlocked_2_2_5: .quad 0
.balign 8
.globl ntp_gettime_2_2_5
.type ntp_gettime_2_2_5, %function
.symver ntp_gettime_2_2_5, ntp_gettime@@GLIBC_2.2.5, remove
ntp_gettime_2_2_5: .quad 0
.balign 8
.globl callrpc_2_2_5
.type callrpc_2_2_5, %function
.symver callrpc_2_2_5, callrpc@@GLIBC_2.2.5, remove
callrpc_2_2_5: .quad 0
.balign 8
.globl mprotect_2_2_5
.type mprotect_2_2_5, %function
.symver mprotect_2_2_5, mprotect@@GLIBC_2.2.5, remove
mprotect_2_2_5: .quad 0
.balign 8
.globl __getlogin_r_chk_2_4
.type __getlogin_r_chk_2_4, %function
.symver __getlogin_r_chk_2_4, __getlogin_r_chk@@GLIBC_2.4, remove
__getlogin_r_chk_2_4: .quad 0
.balign 8
.globl _IO_puts_2_2_5
.type _IO_puts_2_2_5, %function
.symver _IO_puts_2_2_5, _IO_puts@@GLIBC_2.2.5, remove
_IO_puts_2_2_5: .quad 0
.balign 8
.globl __strtold_l_2_2_5
.type __strtold_l_2_2_5, %function
.symver __strtold_l_2_2_5, __strtold_l@@GLIBC_2.2.5, remove
__strtold_l_2_2_5: .quad 0
.balign 8
.globl __memmove_chk_2_3_4
.type __memmove_chk_2_3_4, %function
.symver __memmove_chk_2_3_4, __memmove_chk@@GLIBC_2.3.4, remove
__memmove_chk_2_3_4: .quad 0
.balign 8
.globl fputc_2_2_5
.type fputc_2_2_5, %function
.symver fputc_2_2_5, fputc@@GLIBC_2.2.5, remove
fputc_2_2_5: .quad 0
.balign 8
.globl inet_addr_2_2_5
.type inet_addr_2_2_5, %function
.symver inet_addr_2_2_5, inet_addr@@GLIBC_2.2.5, remove
inet_addr_2_2_5: .quad 0
.balign 8
.globl backtrace_symbols_fd_2_2_5
.type backtrace_symbols_fd_2_2_5, %function
.symver backtrace_symbols_fd_2_2_5, backtrace_symbols_fd@@GLIBC_2.2.5, remove
backtrace_symbols_fd_2_2_5: .quad 0
.balign 8
.globl wcschr_2_2_5
.type wcschr_2_2_5, %function
.symver wcschr_2_2_5, wcschr@@GLIBC_2.2.5, remove
wcschr_2_2_5: .quad 0
.balign 8
.globl getspnam_r_2_2_5
.type getspnam_r_2_2_5, %function
.symver getspnam_r_2_2_5, getspnam_r@@GLIBC_2.2.5, remove
getspnam_r_2_2_5: .quad 0
.balign 8
.globl posix_spawnattr_getschedpolicy_2_2_5
.type posix_spawnattr_getschedpolicy_2_2_5, %function
.symver posix_spawnattr_getschedpolicy_2_2_5, posix_spawnattr_getschedpolicy@@GLIBC_2.2.5, remove
posix_spawnattr_getschedpolicy_2_2_5: .quad 0
.balign 8
.globl lockf_2_2_5
.type lockf_2_2_5, %function
.symver lockf_2_2_5, lockf@@GLIBC_2.2.5, remove
lockf_2_2_5: .quad 0
.balign 8
.globl xdr_long_2_2_5
.type xdr_long_2_2_5, %function
.symver xdr_long_2_2_5, xdr_long@@GLIBC_2.2.5, remove
xdr_long_2_2_5: .quad 0
.balign 8
.globl toascii_2_2_5
.type toascii_2_2_5, %function
.symver toascii_2_2_5, toascii@@GLIBC_2.2.5, remove
toascii_2_2_5: .quad 0
.balign 8
.globl wcscspn_2_2_5
.type wcscspn_2_2_5, %function
.symver wcscspn_2_2_5, wcscspn@@GLIBC_2.2.5, remove
wcscspn_2_2_5: .quad 0
.balign 8
.globl clearerr_2_2_5
.type clearerr_2_2_5, %function
.symver clearerr_2_2_5, clearerr@@GLIBC_2.2.5, remove
clearerr_2_2_5: .quad 0
.balign 8
.globl sigwaitinfo_2_2_5
.type sigwaitinfo_2_2_5, %function
.symver sigwaitinfo_2_2_5, sigwaitinfo@@GLIBC_2.2.5, remove
sigwaitinfo_2_2_5: .quad 0
.balign 8
.globl xdr_cryptkeyarg2_2_2_5
.type xdr_cryptkeyarg2_2_2_5, %function
.symver xdr_cryptkeyarg2_2_2_5, xdr_cryptkeyarg2@@GLIBC_2.2.5, remove
xdr_cryptkeyarg2_2_2_5: .quad 0
.balign 8
.globl __cmsg_nxthdr_2_2_5
.type __cmsg_nxthdr_2_2_5, %function
.symver __cmsg_nxthdr_2_2_5, __cmsg_nxthdr@@GLIBC_2.2.5, remove
__cmsg_nxthdr_2_2_5: .quad 0
.balign 8
.globl xdr_opaque_auth_2_2_5
.type xdr_opaque_auth_2_2_5, %function
.symver xdr_opaque_auth_2_2_5, xdr_opaque_auth@@GLIBC_2.2.5, remove
xdr_opaque_auth_2_2_5: .quad 0
.balign 8
.globl iswupper_2_2_5
.type iswupper_2_2_5, %function
.symver iswupper_2_2_5, iswupper@@GLIBC_2.2.5, remove
iswupper_2_2_5: .quad 0
.balign 8
.globl wmemchr_2_2_5
.type wmemchr_2_2_5, %function
.symver wmemchr_2_2_5, wmemchr@@GLIBC_2.2.5, remove
wmemchr_2_2_5: .quad 0
.balign 8
.globl iscntrl_l_2_3
.type iscntrl_l_2_3, %function
.symver iscntrl_l_2_3, iscntrl_l@@GLIBC_2.3, remove
iscntrl_l_2_3: .quad 0
.balign 8
.globl mcount_2_2_5
.type mcount_2_2_5, %function
.symver mcount_2_2_5, mcount@@GLIBC_2.2.5, remove
mcount_2_2_5: .quad 0
.balign 8
.globl endpwent_2_2_5
.type endpwent_2_2_5, %function
.symver endpwent_2_2_5, endpwent@@GLIBC_2.2.5, remove
endpwent_2_2_5: .quad 0
.balign 8
.globl fwscanf_2_2_5
.type fwscanf_2_2_5, %function
.symver fwscanf_2_2_5, fwscanf@@GLIBC_2.2.5, remove
fwscanf_2_2_5: .quad 0
.balign 8
.globl preadv64_2_10
.type preadv64_2_10, %function
.symver preadv64_2_10, preadv64@@GLIBC_2.10, remove
preadv64_2_10: .quad 0
.balign 8
.globl __iswcntrl_l_2_2_5
.type __iswcntrl_l_2_2_5, %function
.symver __iswcntrl_l_2_2_5, __iswcntrl_l@@GLIBC_2.2.5, remove
__iswcntrl_l_2_2_5: .quad 0
.balign 8
.globl _IO_padn_2_2_5
.type _IO_padn_2_2_5, %function
.symver _IO_padn_2_2_5, _IO_padn@@GLIBC_2.2.5, remove
_IO_padn_2_2_5: .quad 0
.balign 8
.globl getipv4sourcefilter_2_3_4
.type getipv4sourcefilter_2_3_4, %function
.symver getipv4sourcefilter_2_3_4, getipv4sourcefilter@@GLIBC_2.3.4, remove
getipv4sourcefilter_2_3_4: .quad 0
.balign 8
.globl fgetws_2_2_5
.type fgetws_2_2_5, %function
.symver fgetws_2_2_5, fgetws@@GLIBC_2.2.5, remove
fgetws_2_2_5: .quad 0
.balign 8
.globl signalfd_2_7
.type signalfd_2_7, %function
.symver signalfd_2_7, signalfd@@GLIBC_2.7, remove
signalfd_2_7: .quad 0
.balign 8
.globl wcstod_2_2_5
.type wcstod_2_2_5, %function
.symver wcstod_2_2_5, wcstod@@GLIBC_2.2.5, remove
wcstod_2_2_5: .quad 0
.balign 8
.globl _mcount_2_2_5
.type _mcount_2_2_5, %function
.symver _mcount_2_2_5, _mcount@@GLIBC_2.2.5, remove
_mcount_2_2_5: .quad 0
.balign 8
.globl accept4_2_10
.type accept4_2_10, %function
.symver accept4_2_10, accept4@@GLIBC_2.10, remove
accept4_2_10: .quad 0
.balign 8
.globl ungetc_2_2_5
.type ungetc_2_2_5, %function
.symver ungetc_2_2_5, ungetc@@GLIBC_2.2.5, remove
ungetc_2_2_5: .quad 0
.balign 8
.globl llistxattr_2_3
.type llistxattr_2_3, %function
.symver llistxattr_2_3, llistxattr@@GLIBC_2.3, remove
llistxattr_2_3: .quad 0
.balign 8
.globl _IO_feof_2_2_5
.type _IO_feof_2_2_5, %function
.symver _IO_feof_2_2_5, _IO_feof@@GLIBC_2.2.5, remove
_IO_feof_2_2_5: .quad 0
.balign 8
.globl __wcscat_chk_2_4
.type __wcscat_chk_2_4, %function
.symver __wcscat_chk_2_4, __wcscat_chk@@GLIBC_2.4, remove
__wcscat_chk_2_4: .quad 0
.balign 8
.globl clntudp_create_2_2_5
.type clntudp_create_2_2_5, %function
.symver clntudp_create_2_2_5, clntudp_create@@GLIBC_2.2.5, remove
clntudp_create_2_2_5: .quad 0
.balign 8
.globl iswalnum_l_2_3
.type iswalnum_l_2_3, %function
.symver iswalnum_l_2_3, iswalnum_l@@GLIBC_2.3, remove
iswalnum_l_2_3: .quad 0
.balign 8
.globl srand48_2_2_5
.type srand48_2_2_5, %function
.symver srand48_2_2_5, srand48@@GLIBC_2.2.5, remove
srand48_2_2_5: .quad 0
.balign 8
.globl nrand48_r_2_2_5
.type nrand48_r_2_2_5, %function
.symver nrand48_r_2_2_5, nrand48_r@@GLIBC_2.2.5, remove
nrand48_r_2_2_5: .quad 0
.balign 8
.globl madvise_2_2_5
.type madvise_2_2_5, %function
.symver madvise_2_2_5, madvise@@GLIBC_2.2.5, remove
madvise_2_2_5: .quad 0
.balign 8
.globl vwscanf_2_2_5
.type vwscanf_2_2_5, %function
.symver vwscanf_2_2_5, vwscanf@@GLIBC_2.2.5, remove
vwscanf_2_2_5: .quad 0
.balign 8
.globl recv_2_2_5
.type recv_2_2_5, %function
.symver recv_2_2_5, recv@@GLIBC_2.2.5, remove
recv_2_2_5: .quad 0
.balign 8
.globl labs_2_2_5
.type labs_2_2_5, %function
.symver labs_2_2_5, labs@@GLIBC_2.2.5, remove
labs_2_2_5: .quad 0
.balign 8
.globl sgetspent_r_2_2_5
.type sgetspent_r_2_2_5, %function
.symver sgetspent_r_2_2_5, sgetspent_r@@GLIBC_2.2.5, remove
sgetspent_r_2_2_5: .quad 0
.balign 8
.globl __isnan_2_2_5
.type __isnan_2_2_5, %function
.symver __isnan_2_2_5, __isnan@@GLIBC_2.2.5, remove
__isnan_2_2_5: .quad 0
.balign 8
.globl msgrcv_2_2_5
.type msgrcv_2_2_5, %function
.symver msgrcv_2_2_5, msgrcv@@GLIBC_2.2.5, remove
msgrcv_2_2_5: .quad 0
.balign 8
.globl splice_2_5
.type splice_2_5, %function
.symver splice_2_5, splice@@GLIBC_2.5, remove
splice_2_5: .quad 0
.balign 8
.globl __isoc99_swscanf_2_7
.type __isoc99_swscanf_2_7, %function
.symver __isoc99_swscanf_2_7, __isoc99_swscanf@@GLIBC_2.7, remove
__isoc99_swscanf_2_7: .quad 0
.balign 8
.globl lgetxattr_2_3
.type lgetxattr_2_3, %function
.symver lgetxattr_2_3, lgetxattr@@GLIBC_2.3, remove
lgetxattr_2_3: .quad 0
.balign 8
.globl getspent_r_2_2_5
.type getspent_r_2_2_5, %function
.symver getspent_r_2_2_5, getspent_r@@GLIBC_2.2.5, remove
getspent_r_2_2_5: .quad 0
.balign 8
.globl semop_2_2_5
.type semop_2_2_5, %function
.symver semop_2_2_5, semop@@GLIBC_2.2.5, remove
semop_2_2_5: .quad 0
.balign 8
.globl index_2_2_5
.type index_2_2_5, %function
.symver index_2_2_5, index@@GLIBC_2.2.5, remove
index_2_2_5: .quad 0
.balign 8
.globl nl_langinfo_2_2_5
.type nl_langinfo_2_2_5, %function
.symver nl_langinfo_2_2_5, nl_langinfo@@GLIBC_2.2.5, remove
nl_langinfo_2_2_5: .quad 0
.balign 8
.globl iswpunct_l_2_3
.type iswpunct_l_2_3, %function
.symver iswpunct_l_2_3, iswpunct_l@@GLIBC_2.3, remove
iswpunct_l_2_3: .quad 0
.balign 8
.globl pthread_attr_getinheritsched_2_2_5
.type pthread_attr_getinheritsched_2_2_5, %function
.symver pthread_attr_getinheritsched_2_2_5, pthread_attr_getinheritsched@@GLIBC_2.2.5, remove
pthread_attr_getinheritsched_2_2_5: .quad 0
.balign 8
.globl fscanf_2_2_5
.type fscanf_2_2_5, %function
.symver fscanf_2_2_5, fscanf@@GLIBC_2.2.5, remove
fscanf_2_2_5: .quad 0
.balign 8
.globl __sysv_signal_2_2_5
.type __sysv_signal_2_2_5, %function
.symver __sysv_signal_2_2_5, __sysv_signal@@GLIBC_2.2.5, remove
__sysv_signal_2_2_5: .quad 0
.balign 8
.globl frexpf_2_2_5
.type frexpf_2_2_5, %function
.symver frexpf_2_2_5, frexpf@@GLIBC_2.2.5, remove
frexpf_2_2_5: .quad 0
.balign 8
.globl memalign_2_2_5
.type memalign_2_2_5, %function
.symver memalign_2_2_5, memalign@@GLIBC_2.2.5, remove
memalign_2_2_5: .quad 0
.balign 8
.globl getwd_2_2_5
.type getwd_2_2_5, %function
.symver getwd_2_2_5, getwd@@GLIBC_2.2.5, remove
getwd_2_2_5: .quad 0
.balign 8
.globl __close_2_2_5
.type __close_2_2_5, %function
.symver __close_2_2_5, __close@@GLIBC_2.2.5, remove
__close_2_2_5: .quad 0
.balign 8
.globl inet6_option_next_2_3_3
.type inet6_option_next_2_3_3, %function
.symver inet6_option_next_2_3_3, inet6_option_next@@GLIBC_2.3.3, remove
inet6_option_next_2_3_3: .quad 0
.balign 8
.globl rexec_2_2_5
.type rexec_2_2_5, %function
.symver rexec_2_2_5, rexec@@GLIBC_2.2.5, remove
rexec_2_2_5: .quad 0
.balign 8
.globl xdr_longlong_t_2_2_5
.type xdr_longlong_t_2_2_5, %function
.symver xdr_longlong_t_2_2_5, xdr_longlong_t@@GLIBC_2.2.5, remove
xdr_longlong_t_2_2_5: .quad 0
.balign 8
.globl ppoll_2_4
.type ppoll_2_4, %function
.symver ppoll_2_4, ppoll@@GLIBC_2.4, remove
ppoll_2_4: .quad 0
.balign 8
.globl adjtime_2_2_5
.type adjtime_2_2_5, %function
.symver adjtime_2_2_5, adjtime@@GLIBC_2.2.5, remove
adjtime_2_2_5: .quad 0
.balign 8
.globl tcsetpgrp_2_2_5
.type tcsetpgrp_2_2_5, %function
.symver tcsetpgrp_2_2_5, tcsetpgrp@@GLIBC_2.2.5, remove
tcsetpgrp_2_2_5: .quad 0
.balign 8
.globl xdrrec_eof_2_2_5
.type xdrrec_eof_2_2_5, %function
.symver xdrrec_eof_2_2_5, xdrrec_eof@@GLIBC_2.2.5, remove
xdrrec_eof_2_2_5: .quad 0
.balign 8
.globl pututline_2_2_5
.type pututline_2_2_5, %function
.symver pututline_2_2_5, pututline@@GLIBC_2.2.5, remove
pututline_2_2_5: .quad 0
.balign 8
.globl towupper_2_2_5
.type towupper_2_2_5, %function
.symver towupper_2_2_5, towupper@@GLIBC_2.2.5, remove
towupper_2_2_5: .quad 0
.balign 8
.globl tzset_2_2_5
.type tzset_2_2_5, %function
.symver tzset_2_2_5, tzset@@GLIBC_2.2.5, remove
tzset_2_2_5: .quad 0
.balign 8
.globl sysinfo_2_2_5
.type sysinfo_2_2_5, %function
.symver sysinfo_2_2_5, sysinfo@@GLIBC_2.2.5, remove
sysinfo_2_2_5: .quad 0
.balign 8
.globl futimes_2_3
.type futimes_2_3, %function
.symver futimes_2_3, futimes@@GLIBC_2.3, remove
futimes_2_3: .quad 0
.balign 8
.globl truncate64_2_2_5
.type truncate64_2_2_5, %function
.symver truncate64_2_2_5, truncate64@@GLIBC_2.2.5, remove
truncate64_2_2_5: .quad 0
.balign 8
.globl __wcsnrtombs_chk_2_4
.type __wcsnrtombs_chk_2_4, %function
.symver __wcsnrtombs_chk_2_4, __wcsnrtombs_chk@@GLIBC_2.4, remove
__wcsnrtombs_chk_2_4: .quad 0
.balign 8
.globl svc_exit_2_2_5
.type svc_exit_2_2_5, %function
.symver svc_exit_2_2_5, svc_exit@@GLIBC_2.2.5, remove
svc_exit_2_2_5: .quad 0
.balign 8
.globl __fpending_2_2_5
.type __fpending_2_2_5, %function
.symver __fpending_2_2_5, __fpending@@GLIBC_2.2.5, remove
__fpending_2_2_5: .quad 0
.balign 8
.globl wcsftime_2_2_5
.type wcsftime_2_2_5, %function
.symver wcsftime_2_2_5, wcsftime@@GLIBC_2.2.5, remove
wcsftime_2_2_5: .quad 0
.balign 8
.globl getdirentries64_2_2_5
.type getdirentries64_2_2_5, %function
.symver getdirentries64_2_2_5, getdirentries64@@GLIBC_2.2.5, remove
getdirentries64_2_2_5: .quad 0
.balign 8
.globl xprt_unregister_2_2_5
.type xprt_unregister_2_2_5, %function
.symver xprt_unregister_2_2_5, xprt_unregister@@GLIBC_2.2.5, remove
xprt_unregister_2_2_5: .quad 0
.balign 8
.globl iswalnum_2_2_5
.type iswalnum_2_2_5, %function
.symver iswalnum_2_2_5, iswalnum@@GLIBC_2.2.5, remove
iswalnum_2_2_5: .quad 0
.balign 8
.globl execv_2_2_5
.type execv_2_2_5, %function
.symver execv_2_2_5, execv@@GLIBC_2.2.5, remove
execv_2_2_5: .quad 0
.balign 8
.globl vmsplice_2_5
.type vmsplice_2_5, %function
.symver vmsplice_2_5, vmsplice@@GLIBC_2.5, remove
vmsplice_2_5: .quad 0
.balign 8
.globl wcstoimax_2_2_5
.type wcstoimax_2_2_5, %function
.symver wcstoimax_2_2_5, wcstoimax@@GLIBC_2.2.5, remove
wcstoimax_2_2_5: .quad 0
.balign 8
.globl getutid_r_2_2_5
.type getutid_r_2_2_5, %function
.symver getutid_r_2_2_5, getutid_r@@GLIBC_2.2.5, remove
getutid_r_2_2_5: .quad 0
.balign 8
.globl gethostbyname_2_2_5
.type gethostbyname_2_2_5, %function
.symver gethostbyname_2_2_5, gethostbyname@@GLIBC_2.2.5, remove
gethostbyname_2_2_5: .quad 0
.balign 8
.globl setgroups_2_2_5
.type setgroups_2_2_5, %function
.symver setgroups_2_2_5, setgroups@@GLIBC_2.2.5, remove
setgroups_2_2_5: .quad 0
.balign 8
.globl posix_spawnattr_getflags_2_2_5
.type posix_spawnattr_getflags_2_2_5, %function
.symver posix_spawnattr_getflags_2_2_5, posix_spawnattr_getflags@@GLIBC_2.2.5, remove
posix_spawnattr_getflags_2_2_5: .quad 0
.balign 8
.globl cfsetspeed_2_2_5
.type cfsetspeed_2_2_5, %function
.symver cfsetspeed_2_2_5, cfsetspeed@@GLIBC_2.2.5, remove
cfsetspeed_2_2_5: .quad 0
.balign 8
.globl key_setsecret_2_2_5
.type key_setsecret_2_2_5, %function
.symver key_setsecret_2_2_5, key_setsecret@@GLIBC_2.2.5, remove
key_setsecret_2_2_5: .quad 0
.balign 8
.globl pmap_unset_2_2_5
.type pmap_unset_2_2_5, %function
.symver pmap_unset_2_2_5, pmap_unset@@GLIBC_2.2.5, remove
pmap_unset_2_2_5: .quad 0
.balign 8
.globl envz_merge_2_2_5
.type envz_merge_2_2_5, %function
.symver envz_merge_2_2_5, envz_merge@@GLIBC_2.2.5, remove
envz_merge_2_2_5: .quad 0
.balign 8
.globl authnone_create_2_2_5
.type authnone_create_2_2_5, %function
.symver authnone_create_2_2_5, authnone_create@@GLIBC_2.2.5, remove
authnone_create_2_2_5: .quad 0
.balign 8
.globl __getdomainname_chk_2_4
.type __getdomainname_chk_2_4, %function
.symver __getdomainname_chk_2_4, __getdomainname_chk@@GLIBC_2.4, remove
__getdomainname_chk_2_4: .quad 0
.balign 8
.globl setfsuid_2_2_5
.type setfsuid_2_2_5, %function
.symver setfsuid_2_2_5, setfsuid@@GLIBC_2.2.5, remove
setfsuid_2_2_5: .quad 0
.balign 8
.globl pthread_condattr_init_2_2_5
.type pthread_condattr_init_2_2_5, %function
.symver pthread_condattr_init_2_2_5, pthread_condattr_init@@GLIBC_2.2.5, remove
pthread_condattr_init_2_2_5: .quad 0
.balign 8
.globl __wcstold_l_2_2_5
.type __wcstold_l_2_2_5, %function
.symver __wcstold_l_2_2_5, __wcstold_l@@GLIBC_2.2.5, remove
__wcstold_l_2_2_5: .quad 0
.balign 8
.globl getpriority_2_2_5
.type getpriority_2_2_5, %function
.symver getpriority_2_2_5, getpriority@@GLIBC_2.2.5, remove
getpriority_2_2_5: .quad 0
.balign 8
.globl srand48_r_2_2_5
.type srand48_r_2_2_5, %function
.symver srand48_r_2_2_5, srand48_r@@GLIBC_2.2.5, remove
srand48_r_2_2_5: .quad 0
.balign 8
.globl xdr_int32_t_2_2_5
.type xdr_int32_t_2_2_5, %function
.symver xdr_int32_t_2_2_5, xdr_int32_t@@GLIBC_2.2.5, remove
xdr_int32_t_2_2_5: .quad 0
.balign 8
.globl _IO_vsprintf_2_2_5
.type _IO_vsprintf_2_2_5, %function
.symver _IO_vsprintf_2_2_5, _IO_vsprintf@@GLIBC_2.2.5, remove
_IO_vsprintf_2_2_5: .quad 0
.balign 8
.globl mbsnrtowcs_2_2_5
.type mbsnrtowcs_2_2_5, %function
.symver mbsnrtowcs_2_2_5, mbsnrtowcs@@GLIBC_2.2.5, remove
mbsnrtowcs_2_2_5: .quad 0
.balign 8
.globl readdir64_r_2_2_5
.type readdir64_r_2_2_5, %function
.symver readdir64_r_2_2_5, readdir64_r@@GLIBC_2.2.5, remove
readdir64_r_2_2_5: .quad 0
.balign 8
.globl iswxdigit_l_2_3
.type iswxdigit_l_2_3, %function
.symver iswxdigit_l_2_3, iswxdigit_l@@GLIBC_2.3, remove
iswxdigit_l_2_3: .quad 0
.balign 8
.globl muntrace_2_2_5
.type muntrace_2_2_5, %function
.symver muntrace_2_2_5, muntrace@@GLIBC_2.2.5, remove
muntrace_2_2_5: .quad 0
.balign 8
.globl statfs64_2_2_5
.type statfs64_2_2_5, %function
.symver statfs64_2_2_5, statfs64@@GLIBC_2.2.5, remove
statfs64_2_2_5: .quad 0
.balign 8
.globl inet6_option_space_2_3_3
.type inet6_option_space_2_3_3, %function
.symver inet6_option_space_2_3_3, inet6_option_space@@GLIBC_2.3.3, remove
inet6_option_space_2_3_3: .quad 0
.balign 8
.globl wcspbrk_2_2_5
.type wcspbrk_2_2_5, %function
.symver wcspbrk_2_2_5, wcspbrk@@GLIBC_2.2.5, remove
wcspbrk_2_2_5: .quad 0
.balign 8
.globl getpmsg_2_2_5
.type getpmsg_2_2_5, %function
.symver getpmsg_2_2_5, getpmsg@@GLIBC_2.2.5, remove
getpmsg_2_2_5: .quad 0
.balign 8
.globl svc_sendreply_2_2_5
.type svc_sendreply_2_2_5, %function
.symver svc_sendreply_2_2_5, svc_sendreply@@GLIBC_2.2.5, remove
svc_sendreply_2_2_5: .quad 0
.balign 8
.globl futimens_2_6
.type futimens_2_6, %function
.symver futimens_2_6, futimens@@GLIBC_2.6, remove
futimens_2_6: .quad 0
.balign 8
.globl endnetent_2_2_5
.type endnetent_2_2_5, %function
.symver endnetent_2_2_5, endnetent@@GLIBC_2.2.5, remove
endnetent_2_2_5: .quad 0
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
.globl preadv_2_10
.type preadv_2_10, %function
.symver preadv_2_10, preadv@@GLIBC_2.10, remove
preadv_2_10: .quad 0
.balign 8
.globl fts_close_2_2_5
.type fts_close_2_2_5, %function
.symver fts_close_2_2_5, fts_close@@GLIBC_2.2.5, remove
fts_close_2_2_5: .quad 0
.balign 8
.globl __isoc99_fwscanf_2_7
.type __isoc99_fwscanf_2_7, %function
.symver __isoc99_fwscanf_2_7, __isoc99_fwscanf@@GLIBC_2.7, remove
__isoc99_fwscanf_2_7: .quad 0
.balign 8
.globl __printf_chk_2_3_4
.type __printf_chk_2_3_4, %function
.symver __printf_chk_2_3_4, __printf_chk@@GLIBC_2.3.4, remove
__printf_chk_2_3_4: .quad 0
.balign 8
.globl get_myaddress_2_2_5
.type get_myaddress_2_2_5, %function
.symver get_myaddress_2_2_5, get_myaddress@@GLIBC_2.2.5, remove
get_myaddress_2_2_5: .quad 0
.balign 8
.globl user2netname_2_2_5
.type user2netname_2_2_5, %function
.symver user2netname_2_2_5, user2netname@@GLIBC_2.2.5, remove
user2netname_2_2_5: .quad 0
.balign 8
.globl svc_getreqset_2_2_5
.type svc_getreqset_2_2_5, %function
.symver svc_getreqset_2_2_5, svc_getreqset@@GLIBC_2.2.5, remove
svc_getreqset_2_2_5: .quad 0
.balign 8
.globl clnt_broadcast_2_2_5
.type clnt_broadcast_2_2_5, %function
.symver clnt_broadcast_2_2_5, clnt_broadcast@@GLIBC_2.2.5, remove
clnt_broadcast_2_2_5: .quad 0
.balign 8
.globl getopt_long_only_2_2_5
.type getopt_long_only_2_2_5, %function
.symver getopt_long_only_2_2_5, getopt_long_only@@GLIBC_2.2.5, remove
getopt_long_only_2_2_5: .quad 0
.balign 8
.globl fwrite_2_2_5
.type fwrite_2_2_5, %function
.symver fwrite_2_2_5, fwrite@@GLIBC_2.2.5, remove
fwrite_2_2_5: .quad 0
.balign 8
.globl __libc_init_first_2_2_5
.type __libc_init_first_2_2_5, %function
.symver __libc_init_first_2_2_5, __libc_init_first@@GLIBC_2.2.5, remove
__libc_init_first_2_2_5: .quad 0
.balign 8
.globl sysctl_2_2_5
.type sysctl_2_2_5, %function
.symver sysctl_2_2_5, sysctl@@GLIBC_2.2.5, remove
sysctl_2_2_5: .quad 0
.balign 8
.globl fchmod_2_2_5
.type fchmod_2_2_5, %function
.symver fchmod_2_2_5, fchmod@@GLIBC_2.2.5, remove
fchmod_2_2_5: .quad 0
.balign 8
.globl getgroups_2_2_5
.type getgroups_2_2_5, %function
.symver getgroups_2_2_5, getgroups@@GLIBC_2.2.5, remove
getgroups_2_2_5: .quad 0
.balign 8
.globl pipe_2_2_5
.type pipe_2_2_5, %function
.symver pipe_2_2_5, pipe@@GLIBC_2.2.5, remove
pipe_2_2_5: .quad 0
.balign 8
.globl __strspn_c1_2_2_5
.type __strspn_c1_2_2_5, %function
.symver __strspn_c1_2_2_5, __strspn_c1@@GLIBC_2.2.5, remove
__strspn_c1_2_2_5: .quad 0
.balign 8
.globl fseeko_2_2_5
.type fseeko_2_2_5, %function
.symver fseeko_2_2_5, fseeko@@GLIBC_2.2.5, remove
fseeko_2_2_5: .quad 0
.balign 8
.globl iswprint_l_2_3
.type iswprint_l_2_3, %function
.symver iswprint_l_2_3, iswprint_l@@GLIBC_2.3, remove
iswprint_l_2_3: .quad 0
.balign 8
.globl strfry_2_2_5
.type strfry_2_2_5, %function
.symver strfry_2_2_5, strfry@@GLIBC_2.2.5, remove
strfry_2_2_5: .quad 0
.balign 8
.globl pthread_attr_getdetachstate_2_2_5
.type pthread_attr_getdetachstate_2_2_5, %function
.symver pthread_attr_getdetachstate_2_2_5, pthread_attr_getdetachstate@@GLIBC_2.2.5, remove
pthread_attr_getdetachstate_2_2_5: .quad 0
.balign 8
.globl setspent_2_2_5
.type setspent_2_2_5, %function
.symver setspent_2_2_5, setspent@@GLIBC_2.2.5, remove
setspent_2_2_5: .quad 0
.balign 8
.globl re_match_2_2_2_5
.type re_match_2_2_2_5, %function
.symver re_match_2_2_2_5, re_match_2@@GLIBC_2.2.5, remove
re_match_2_2_2_5: .quad 0
.balign 8
.globl xdr_authdes_cred_2_2_5
.type xdr_authdes_cred_2_2_5, %function
.symver xdr_authdes_cred_2_2_5, xdr_authdes_cred@@GLIBC_2.2.5, remove
xdr_authdes_cred_2_2_5: .quad 0
.balign 8
.globl __iswgraph_l_2_2_5
.type __iswgraph_l_2_2_5, %function
.symver __iswgraph_l_2_2_5, __iswgraph_l@@GLIBC_2.2.5, remove
__iswgraph_l_2_2_5: .quad 0
.balign 8
.globl clearerr_unlocked_2_2_5
.type clearerr_unlocked_2_2_5, %function
.symver clearerr_unlocked_2_2_5, clearerr_unlocked@@GLIBC_2.2.5, remove
clearerr_unlocked_2_2_5: .quad 0
.balign 8
.globl _IO_vfscanf_2_2_5
.type _IO_vfscanf_2_2_5, %function
.symver _IO_vfscanf_2_2_5, _IO_vfscanf@@GLIBC_2.2.5, remove
_IO_vfscanf_2_2_5: .quad 0
.balign 8
.globl ualarm_2_2_5
.type ualarm_2_2_5, %function
.symver ualarm_2_2_5, ualarm@@GLIBC_2.2.5, remove
ualarm_2_2_5: .quad 0
.balign 8
.globl svcudp_bufcreate_2_2_5
.type svcudp_bufcreate_2_2_5, %function
.symver svcudp_bufcreate_2_2_5, svcudp_bufcreate@@GLIBC_2.2.5, remove
svcudp_bufcreate_2_2_5: .quad 0
.balign 8
.globl setpgid_2_2_5
.type setpgid_2_2_5, %function
.symver setpgid_2_2_5, setpgid@@GLIBC_2.2.5, remove
setpgid_2_2_5: .quad 0
.balign 8
.globl __fdelt_warn_2_15
.type __fdelt_warn_2_15, %function
.symver __fdelt_warn_2_15, __fdelt_warn@@GLIBC_2.15, remove
__fdelt_warn_2_15: .quad 0
.balign 8
.globl fputs_2_2_5
.type fputs_2_2_5, %function
.symver fputs_2_2_5, fputs@@GLIBC_2.2.5, remove
fputs_2_2_5: .quad 0
.balign 8
.globl rexec_af_2_2_5
.type rexec_af_2_2_5, %function
.symver rexec_af_2_2_5, rexec_af@@GLIBC_2.2.5, remove
rexec_af_2_2_5: .quad 0
.balign 8
.globl inet_lnaof_2_2_5
.type inet_lnaof_2_2_5, %function
.symver inet_lnaof_2_2_5, inet_lnaof@@GLIBC_2.2.5, remove
inet_lnaof_2_2_5: .quad 0
.balign 8
.globl _IO_seekpos_2_2_5
.type _IO_seekpos_2_2_5, %function
.symver _IO_seekpos_2_2_5, _IO_seekpos@@GLIBC_2.2.5, remove
_IO_seekpos_2_2_5: .quad 0
.balign 8
.globl __setmntent_2_2_5
.type __setmntent_2_2_5, %function
.symver __setmntent_2_2_5, __setmntent@@GLIBC_2.2.5, remove
__setmntent_2_2_5: .quad 0
.balign 8
.globl symlink_2_2_5
.type symlink_2_2_5, %function
.symver symlink_2_2_5, symlink@@GLIBC_2.2.5, remove
symlink_2_2_5: .quad 0
.balign 8
.globl isatty_2_2_5
.type isatty_2_2_5, %function
.symver isatty_2_2_5, isatty@@GLIBC_2.2.5, remove
isatty_2_2_5: .quad 0
.balign 8
.globl clnt_sperror_2_2_5
.type clnt_sperror_2_2_5, %function
.symver clnt_sperror_2_2_5, clnt_sperror@@GLIBC_2.2.5, remove
clnt_sperror_2_2_5: .quad 0
.balign 8
.globl svcerr_decode_2_2_5
.type svcerr_decode_2_2_5, %function
.symver svcerr_decode_2_2_5, svcerr_decode@@GLIBC_2.2.5, remove
svcerr_decode_2_2_5: .quad 0
.balign 8
.globl clntunix_create_2_2_5
.type clntunix_create_2_2_5, %function
.symver clntunix_create_2_2_5, clntunix_create@@GLIBC_2.2.5, remove
clntunix_create_2_2_5: .quad 0
.balign 8
.globl _IO_wdoallocbuf_2_2_5
.type _IO_wdoallocbuf_2_2_5, %function
.symver _IO_wdoallocbuf_2_2_5, _IO_wdoallocbuf@@GLIBC_2.2.5, remove
_IO_wdoallocbuf_2_2_5: .quad 0
.balign 8
.globl _IO_free_wbackup_area_2_2_5
.type _IO_free_wbackup_area_2_2_5, %function
.symver _IO_free_wbackup_area_2_2_5, _IO_free_wbackup_area@@GLIBC_2.2.5, remove
_IO_free_wbackup_area_2_2_5: .quad 0
.balign 8
.globl __secure_getenv_2_2_5
.type __secure_getenv_2_2_5, %function
.symver __secure_getenv_2_2_5, __secure_getenv@@GLIBC_2.2.5, remove
__secure_getenv_2_2_5: .quad 0
.balign 8
.globl umask_2_2_5
.type umask_2_2_5, %function
.symver umask_2_2_5, umask@@GLIBC_2.2.5, remove
umask_2_2_5: .quad 0
.balign 8
.globl __strcspn_c2_2_2_5
.type __strcspn_c2_2_2_5, %function
.symver __strcspn_c2_2_2_5, __strcspn_c2@@GLIBC_2.2.5, remove
__strcspn_c2_2_2_5: .quad 0
.balign 8
.globl pvalloc_2_2_5
.type pvalloc_2_2_5, %function
.symver pvalloc_2_2_5, pvalloc@@GLIBC_2.2.5, remove
pvalloc_2_2_5: .quad 0
.balign 8
.globl siglongjmp_2_2_5
.type siglongjmp_2_2_5, %function
.symver siglongjmp_2_2_5, siglongjmp@@GLIBC_2.2.5, remove
siglongjmp_2_2_5: .quad 0
.balign 8
.globl srandom_r_2_2_5
.type srandom_r_2_2_5, %function
.symver srandom_r_2_2_5, srandom_r@@GLIBC_2.2.5, remove
srandom_r_2_2_5: .quad 0
.balign 8
.globl execl_2_2_5
.type execl_2_2_5, %function
.symver execl_2_2_5, execl@@GLIBC_2.2.5, remove
execl_2_2_5: .quad 0
.balign 8
.globl gnu_dev_minor_2_3_3
.type gnu_dev_minor_2_3_3, %function
.symver gnu_dev_minor_2_3_3, gnu_dev_minor@@GLIBC_2.3.3, remove
gnu_dev_minor_2_3_3: .quad 0
.balign 8
.globl re_compile_fastmap_2_2_5
.type re_compile_fastmap_2_2_5, %function
.symver re_compile_fastmap_2_2_5, re_compile_fastmap@@GLIBC_2.2.5, remove
re_compile_fastmap_2_2_5: .quad 0
.balign 8
.globl vlimit_2_2_5
.type vlimit_2_2_5, %function
.symver vlimit_2_2_5, vlimit@@GLIBC_2.2.5, remove
vlimit_2_2_5: .quad 0
.balign 8
.globl rresvport_2_2_5
.type rresvport_2_2_5, %function
.symver rresvport_2_2_5, rresvport@@GLIBC_2.2.5, remove
rresvport_2_2_5: .quad 0
.balign 8
.globl __wcstof_l_2_2_5
.type __wcstof_l_2_2_5, %function
.symver __wcstof_l_2_2_5, __wcstof_l@@GLIBC_2.2.5, remove
__wcstof_l_2_2_5: .quad 0
.balign 8
.globl envz_remove_2_2_5
.type envz_remove_2_2_5, %function
.symver envz_remove_2_2_5, envz_remove@@GLIBC_2.2.5, remove
envz_remove_2_2_5: .quad 0
.balign 8
.globl tolower_l_2_3
.type tolower_l_2_3, %function
.symver tolower_l_2_3, tolower_l@@GLIBC_2.3, remove
tolower_l_2_3: .quad 0
.balign 8
.globl fgetgrent_r_2_2_5
.type fgetgrent_r_2_2_5, %function
.symver fgetgrent_r_2_2_5, fgetgrent_r@@GLIBC_2.2.5, remove
fgetgrent_r_2_2_5: .quad 0
.balign 8
.globl argp_parse_2_2_5
.type argp_parse_2_2_5, %function
.symver argp_parse_2_2_5, argp_parse@@GLIBC_2.2.5, remove
argp_parse_2_2_5: .quad 0
.balign 8
.globl swprintf_2_2_5
.type swprintf_2_2_5, %function
.symver swprintf_2_2_5, swprintf@@GLIBC_2.2.5, remove
swprintf_2_2_5: .quad 0
.balign 8
.globl ioctl_2_2_5
.type ioctl_2_2_5, %function
.symver ioctl_2_2_5, ioctl@@GLIBC_2.2.5, remove
ioctl_2_2_5: .quad 0
.balign 8
.globl getcwd_2_2_5
.type getcwd_2_2_5, %function
.symver getcwd_2_2_5, getcwd@@GLIBC_2.2.5, remove
getcwd_2_2_5: .quad 0
.balign 8
.globl setsourcefilter_2_3_4
.type setsourcefilter_2_3_4, %function
.symver setsourcefilter_2_3_4, setsourcefilter@@GLIBC_2.3.4, remove
setsourcefilter_2_3_4: .quad 0
.balign 8
.globl inet6_rth_init_2_5
.type inet6_rth_init_2_5, %function
.symver inet6_rth_init_2_5, inet6_rth_init@@GLIBC_2.5, remove
inet6_rth_init_2_5: .quad 0
.balign 8
.globl fstatvfs64_2_2_5
.type fstatvfs64_2_2_5, %function
.symver fstatvfs64_2_2_5, fstatvfs64@@GLIBC_2.2.5, remove
fstatvfs64_2_2_5: .quad 0
.balign 8
.globl printf_2_2_5
.type printf_2_2_5, %function
.symver printf_2_2_5, printf@@GLIBC_2.2.5, remove
printf_2_2_5: .quad 0
.balign 8
.globl setbuf_2_2_5
.type setbuf_2_2_5, %function
.symver setbuf_2_2_5, setbuf@@GLIBC_2.2.5, remove
setbuf_2_2_5: .quad 0
.balign 8
.globl __clone_2_2_5
.type __clone_2_2_5, %function
.symver __clone_2_2_5, __clone@@GLIBC_2.2.5, remove
__clone_2_2_5: .quad 0
.balign 8
.globl fgetpwent_r_2_2_5
.type fgetpwent_r_2_2_5, %function
.symver fgetpwent_r_2_2_5, fgetpwent_r@@GLIBC_2.2.5, remove
fgetpwent_r_2_2_5: .quad 0
.balign 8
.globl seekdir_2_2_5
.type seekdir_2_2_5, %function
.symver seekdir_2_2_5, seekdir@@GLIBC_2.2.5, remove
seekdir_2_2_5: .quad 0
.balign 8
.globl __towlower_l_2_2_5
.type __towlower_l_2_2_5, %function
.symver __towlower_l_2_2_5, __towlower_l@@GLIBC_2.2.5, remove
__towlower_l_2_2_5: .quad 0
.balign 8
.globl key_gendes_2_2_5
.type key_gendes_2_2_5, %function
.symver key_gendes_2_2_5, key_gendes@@GLIBC_2.2.5, remove
key_gendes_2_2_5: .quad 0
.rodata
.balign 8
.globl _IO_stdin_used
.quad _IO_stdin_used
.data
.balign 8
.globl program_invocation_short_name_2_2_5
.type program_invocation_short_name_2_2_5, %object
.size program_invocation_short_name_2_2_5, 8
.symver program_invocation_short_name_2_2_5, program_invocation_short_name@@GLIBC_2.2.5, remove
program_invocation_short_name_2_2_5: .fill 8, 1, 0
.balign 8
.globl __after_morecore_hook_2_2_5
.type __after_morecore_hook_2_2_5, %object
.size __after_morecore_hook_2_2_5, 8
.symver __after_morecore_hook_2_2_5, __after_morecore_hook@@GLIBC_2.2.5, remove
__after_morecore_hook_2_2_5: .fill 8, 1, 0
.balign 8
.globl __memalign_hook_2_2_5
.type __memalign_hook_2_2_5, %object
.size __memalign_hook_2_2_5, 8
.symver __memalign_hook_2_2_5, __memalign_hook@@GLIBC_2.2.5, remove
__memalign_hook_2_2_5: .fill 8, 1, 0
.balign 8
.globl obstack_alloc_failed_handler_2_2_5
.type obstack_alloc_failed_handler_2_2_5, %object
.size obstack_alloc_failed_handler_2_2_5, 8
.symver obstack_alloc_failed_handler_2_2_5, obstack_alloc_failed_handler@@GLIBC_2.2.5, remove
obstack_alloc_failed_handler_2_2_5: .fill 8, 1, 0
.balign 8
.globl opterr_2_2_5
.type opterr_2_2_5, %object
.size opterr_2_2_5, 4
.symver opterr_2_2_5, opterr@@GLIBC_2.2.5, remove
opterr_2_2_5: .fill 4, 1, 0
.balign 8
.globl argp_program_bug_address_2_2_5
.type argp_program_bug_address_2_2_5, %object
.size argp_program_bug_address_2_2_5, 8
.symver argp_program_bug_address_2_2_5, argp_program_bug_address@@GLIBC_2.2.5, remove
argp_program_bug_address_2_2_5: .fill 8, 1, 0
.balign 8
.globl _sys_nerr_2_4
.type _sys_nerr_2_4, %object
.size _sys_nerr_2_4, 4
.symver _sys_nerr_2_4, _sys_nerr@GLIBC_2.4, remove
_sys_nerr_2_4: .fill 4, 1, 0
.balign 8
.globl _sys_nerr_2_12
.type _sys_nerr_2_12, %object
.size _sys_nerr_2_12, 4
.symver _sys_nerr_2_12, _sys_nerr@@GLIBC_2.12, remove
_sys_nerr_2_12: .fill 4, 1, 0
.balign 8
.globl _sys_nerr_2_2_5
.type _sys_nerr_2_2_5, %object
.size _sys_nerr_2_2_5, 4
.symver _sys_nerr_2_2_5, _sys_nerr@GLIBC_2.2.5, remove
_sys_nerr_2_2_5: .fill 4, 1, 0
.balign 8
.globl _sys_nerr_2_3
.type _sys_nerr_2_3, %object
.size _sys_nerr_2_3, 4
.symver _sys_nerr_2_3, _sys_nerr@GLIBC_2.3, remove
_sys_nerr_2_3: .fill 4, 1, 0
.balign 8
.globl svc_max_pollfd_2_2_5
.type svc_max_pollfd_2_2_5, %object
.size svc_max_pollfd_2_2_5, 4
.symver svc_max_pollfd_2_2_5, svc_max_pollfd@@GLIBC_2.2.5, remove
svc_max_pollfd_2_2_5: .fill 4, 1, 0
.balign 8
.globl _IO_file_jumps_2_2_5
.type _IO_file_jumps_2_2_5, %object
.size _IO_file_jumps_2_2_5, 168
.symver _IO_file_jumps_2_2_5, _IO_file_jumps@@GLIBC_2.2.5, remove
_IO_file_jumps_2_2_5: .fill 168, 1, 0
.balign 8
.globl __ctype32_tolower_2_2_5
.type __ctype32_tolower_2_2_5, %object
.size __ctype32_tolower_2_2_5, 8
.symver __ctype32_tolower_2_2_5, __ctype32_tolower@@GLIBC_2.2.5, remove
__ctype32_tolower_2_2_5: .fill 8, 1, 0
.balign 8
.globl mallwatch_2_2_5
.type mallwatch_2_2_5, %object
.size mallwatch_2_2_5, 8
.symver mallwatch_2_2_5, mallwatch@@GLIBC_2.2.5, remove
mallwatch_2_2_5: .fill 8, 1, 0
.balign 8
.globl tzname_2_2_5
.type tzname_2_2_5, %object
.size tzname_2_2_5, 16
.symver tzname_2_2_5, tzname@@GLIBC_2.2.5, remove
tzname_2_2_5: .fill 16, 1, 0
.balign 8
.globl daylight_2_2_5
.type daylight_2_2_5, %object
.size daylight_2_2_5, 4
.symver daylight_2_2_5, daylight@@GLIBC_2.2.5, remove
daylight_2_2_5: .fill 4, 1, 0
.balign 8
.globl __tzname_2_2_5
.type __tzname_2_2_5, %object
.size __tzname_2_2_5, 16
.symver __tzname_2_2_5, __tzname@@GLIBC_2.2.5, remove
__tzname_2_2_5: .fill 16, 1, 0
.balign 8
.globl _libc_intl_domainname_2_2_5
.type _libc_intl_domainname_2_2_5, %object
.size _libc_intl_domainname_2_2_5, 5
.symver _libc_intl_domainname_2_2_5, _libc_intl_domainname@@GLIBC_2.2.5, remove
_libc_intl_domainname_2_2_5: .fill 5, 1, 0
.balign 8
.globl error_print_progname_2_2_5
.type error_print_progname_2_2_5, %object
.size error_print_progname_2_2_5, 8
.symver error_print_progname_2_2_5, error_print_progname@@GLIBC_2.2.5, remove
error_print_progname_2_2_5: .fill 8, 1, 0
.balign 8
.globl error_one_per_line_2_2_5
.type error_one_per_line_2_2_5, %object
.size error_one_per_line_2_2_5, 4
.symver error_one_per_line_2_2_5, error_one_per_line@@GLIBC_2.2.5, remove
error_one_per_line_2_2_5: .fill 4, 1, 0
.balign 8
.globl in6addr_loopback_2_2_5
.type in6addr_loopback_2_2_5, %object
.size in6addr_loopback_2_2_5, 16
.symver in6addr_loopback_2_2_5, in6addr_loopback@@GLIBC_2.2.5, remove
in6addr_loopback_2_2_5: .fill 16, 1, 0
.balign 8
.globl optopt_2_2_5
.type optopt_2_2_5, %object
.size optopt_2_2_5, 4
.symver optopt_2_2_5, optopt@@GLIBC_2.2.5, remove
optopt_2_2_5: .fill 4, 1, 0
.balign 8
.globl argp_program_version_2_2_5
.type argp_program_version_2_2_5, %object
.size argp_program_version_2_2_5, 8
.symver argp_program_version_2_2_5, argp_program_version@@GLIBC_2.2.5, remove
argp_program_version_2_2_5: .fill 8, 1, 0
.balign 8
.globl argp_err_exit_status_2_2_5
.type argp_err_exit_status_2_2_5, %object
.size argp_err_exit_status_2_2_5, 4
.symver argp_err_exit_status_2_2_5, argp_err_exit_status@@GLIBC_2.2.5, remove
argp_err_exit_status_2_2_5: .fill 4, 1, 0
.balign 8
.globl _IO_wfile_jumps_2_2_5
.type _IO_wfile_jumps_2_2_5, %object
.size _IO_wfile_jumps_2_2_5, 168
.symver _IO_wfile_jumps_2_2_5, _IO_wfile_jumps@@GLIBC_2.2.5, remove
_IO_wfile_jumps_2_2_5: .fill 168, 1, 0
.balign 8
.globl __fpu_control_2_2_5
.type __fpu_control_2_2_5, %object
.size __fpu_control_2_2_5, 2
.symver __fpu_control_2_2_5, __fpu_control@@GLIBC_2.2.5, remove
__fpu_control_2_2_5: .fill 2, 1, 0
.balign 8
.globl svc_fdset_2_2_5
.type svc_fdset_2_2_5, %object
.size svc_fdset_2_2_5, 128
.symver svc_fdset_2_2_5, svc_fdset@@GLIBC_2.2.5, remove
svc_fdset_2_2_5: .fill 128, 1, 0
.balign 8
.globl _nl_msg_cat_cntr_2_2_5
.type _nl_msg_cat_cntr_2_2_5, %object
.size _nl_msg_cat_cntr_2_2_5, 4
.symver _nl_msg_cat_cntr_2_2_5, _nl_msg_cat_cntr@@GLIBC_2.2.5, remove
_nl_msg_cat_cntr_2_2_5: .fill 4, 1, 0
.balign 8
.globl __progname_2_2_5
.type __progname_2_2_5, %object
.size __progname_2_2_5, 8
.symver __progname_2_2_5, __progname@@GLIBC_2.2.5, remove
__progname_2_2_5: .fill 8, 1, 0
.balign 8
.globl argp_program_version_hook_2_2_5
.type argp_program_version_hook_2_2_5, %object
.size argp_program_version_hook_2_2_5, 8
.symver argp_program_version_hook_2_2_5, argp_program_version_hook@@GLIBC_2.2.5, remove
argp_program_version_hook_2_2_5: .fill 8, 1, 0
.balign 8
.globl __check_rhosts_file_2_2_5
.type __check_rhosts_file_2_2_5, %object
.size __check_rhosts_file_2_2_5, 4
.symver __check_rhosts_file_2_2_5, __check_rhosts_file@@GLIBC_2.2.5, remove
__check_rhosts_file_2_2_5: .fill 4, 1, 0
.balign 8
.globl _sys_siglist_2_2_5
.type _sys_siglist_2_2_5, %object
.size _sys_siglist_2_2_5, 512
.symver _sys_siglist_2_2_5, _sys_siglist@GLIBC_2.2.5, remove
_sys_siglist_2_2_5: .fill 512, 1, 0
.balign 8
.globl _sys_siglist_2_3_3
.type _sys_siglist_2_3_3, %object
.size _sys_siglist_2_3_3, 520
.symver _sys_siglist_2_3_3, _sys_siglist@@GLIBC_2.3.3, remove
_sys_siglist_2_3_3: .fill 520, 1, 0
.balign 8
.globl in6addr_any_2_2_5
.type in6addr_any_2_2_5, %object
.size in6addr_any_2_2_5, 16
.symver in6addr_any_2_2_5, in6addr_any@@GLIBC_2.2.5, remove
in6addr_any_2_2_5: .fill 16, 1, 0
.balign 8
.globl __ctype32_toupper_2_2_5
.type __ctype32_toupper_2_2_5, %object
.size __ctype32_toupper_2_2_5, 8
.symver __ctype32_toupper_2_2_5, __ctype32_toupper@@GLIBC_2.2.5, remove
__ctype32_toupper_2_2_5: .fill 8, 1, 0
.balign 8
.globl environ_2_2_5
.type environ_2_2_5, %object
.size environ_2_2_5, 8
.symver environ_2_2_5, environ@@GLIBC_2.2.5, remove
environ_2_2_5: .fill 8, 1, 0
.balign 8
.globl __daylight_2_2_5
.type __daylight_2_2_5, %object
.size __daylight_2_2_5, 4
.symver __daylight_2_2_5, __daylight@@GLIBC_2.2.5, remove
__daylight_2_2_5: .fill 4, 1, 0
.balign 8
.globl obstack_exit_failure_2_2_5
.type obstack_exit_failure_2_2_5, %object
.size obstack_exit_failure_2_2_5, 4
.symver obstack_exit_failure_2_2_5, obstack_exit_failure@@GLIBC_2.2.5, remove
obstack_exit_failure_2_2_5: .fill 4, 1, 0
.balign 8
.globl _environ_2_2_5
.type _environ_2_2_5, %object
.size _environ_2_2_5, 8
.symver _environ_2_2_5, _environ@@GLIBC_2.2.5, remove
_environ_2_2_5: .fill 8, 1, 0
.balign 8
.globl program_invocation_name_2_2_5
.type program_invocation_name_2_2_5, %object
.size program_invocation_name_2_2_5, 8
.symver program_invocation_name_2_2_5, program_invocation_name@@GLIBC_2.2.5, remove
program_invocation_name_2_2_5: .fill 8, 1, 0
.balign 8
.globl rexecoptions_2_2_5
.type rexecoptions_2_2_5, %object
.size rexecoptions_2_2_5, 4
.symver rexecoptions_2_2_5, rexecoptions@@GLIBC_2.2.5, remove
rexecoptions_2_2_5: .fill 4, 1, 0
.balign 8
.globl __free_hook_2_2_5
.type __free_hook_2_2_5, %object
.size __free_hook_2_2_5, 8
.symver __free_hook_2_2_5, __free_hook@@GLIBC_2.2.5, remove
__free_hook_2_2_5: .fill 8, 1, 0
.balign 8
.globl __key_decryptsession_pk_LOCAL_2_2_5
.type __key_decryptsession_pk_LOCAL_2_2_5, %object
.size __key_decryptsession_pk_LOCAL_2_2_5, 8
.symver __key_decryptsession_pk_LOCAL_2_2_5, __key_decryptsession_pk_LOCAL@@GLIBC_2.2.5, remove
__key_decryptsession_pk_LOCAL_2_2_5: .fill 8, 1, 0
.balign 8
.globl _res_2_2_5
.type _res_2_2_5, %object
.size _res_2_2_5, 568
.symver _res_2_2_5, _res@@GLIBC_2.2.5, remove
_res_2_2_5: .fill 568, 1, 0
.balign 8
.globl __ctype_b_2_2_5
.type __ctype_b_2_2_5, %object
.size __ctype_b_2_2_5, 8
.symver __ctype_b_2_2_5, __ctype_b@@GLIBC_2.2.5, remove
__ctype_b_2_2_5: .fill 8, 1, 0
.balign 8
.globl __ctype_tolower_2_2_5
.type __ctype_tolower_2_2_5, %object
.size __ctype_tolower_2_2_5, 8
.symver __ctype_tolower_2_2_5, __ctype_tolower@@GLIBC_2.2.5, remove
__ctype_tolower_2_2_5: .fill 8, 1, 0
.balign 8
.globl locs_2_2_5
.type locs_2_2_5, %object
.size locs_2_2_5, 8
.symver locs_2_2_5, locs@@GLIBC_2.2.5, remove
locs_2_2_5: .fill 8, 1, 0
.balign 8
.globl _obstack_2_2_5
.type _obstack_2_2_5, %object
.size _obstack_2_2_5, 8
.symver _obstack_2_2_5, _obstack@@GLIBC_2.2.5, remove
_obstack_2_2_5: .fill 8, 1, 0
.balign 8
.globl __environ_2_2_5
.type __environ_2_2_5, %object
.size __environ_2_2_5, 8
.symver __environ_2_2_5, __environ@@GLIBC_2.2.5, remove
__environ_2_2_5: .fill 8, 1, 0
.balign 8
.globl sys_siglist_2_2_5
.type sys_siglist_2_2_5, %object
.size sys_siglist_2_2_5, 512
.symver sys_siglist_2_2_5, sys_siglist@GLIBC_2.2.5, remove
sys_siglist_2_2_5: .fill 512, 1, 0
.balign 8
.globl sys_siglist_2_3_3
.type sys_siglist_2_3_3, %object
.size sys_siglist_2_3_3, 520
.symver sys_siglist_2_3_3, sys_siglist@@GLIBC_2.3.3, remove
sys_siglist_2_3_3: .fill 520, 1, 0
.balign 8
.globl __rcmd_errstr_2_2_5
.type __rcmd_errstr_2_2_5, %object
.size __rcmd_errstr_2_2_5, 8
.symver __rcmd_errstr_2_2_5, __rcmd_errstr@@GLIBC_2.2.5, remove
__rcmd_errstr_2_2_5: .fill 8, 1, 0
.balign 8
.globl sys_sigabbrev_2_2_5
.type sys_sigabbrev_2_2_5, %object
.size sys_sigabbrev_2_2_5, 512
.symver sys_sigabbrev_2_2_5, sys_sigabbrev@GLIBC_2.2.5, remove
sys_sigabbrev_2_2_5: .fill 512, 1, 0
.balign 8
.globl sys_sigabbrev_2_3_3
.type sys_sigabbrev_2_3_3, %object
.size sys_sigabbrev_2_3_3, 520
.symver sys_sigabbrev_2_3_3, sys_sigabbrev@@GLIBC_2.3.3, remove
sys_sigabbrev_2_3_3: .fill 520, 1, 0
.balign 8
.globl getdate_err_2_2_5
.type getdate_err_2_2_5, %object
.size getdate_err_2_2_5, 4
.symver getdate_err_2_2_5, getdate_err@@GLIBC_2.2.5, remove
getdate_err_2_2_5: .fill 4, 1, 0
.balign 8
.globl _sys_errlist_2_2_5
.type _sys_errlist_2_2_5, %object
.size _sys_errlist_2_2_5, 1000
.symver _sys_errlist_2_2_5, _sys_errlist@GLIBC_2.2.5, remove
_sys_errlist_2_2_5: .fill 1000, 1, 0
.balign 8
.globl _sys_errlist_2_3
.type _sys_errlist_2_3, %object
.size _sys_errlist_2_3, 1008
.symver _sys_errlist_2_3, _sys_errlist@GLIBC_2.3, remove
_sys_errlist_2_3: .fill 1008, 1, 0
.balign 8
.globl _sys_errlist_2_4
.type _sys_errlist_2_4, %object
.size _sys_errlist_2_4, 1056
.symver _sys_errlist_2_4, _sys_errlist@GLIBC_2.4, remove
_sys_errlist_2_4: .fill 1056, 1, 0
.balign 8
.globl _sys_errlist_2_12
.type _sys_errlist_2_12, %object
.size _sys_errlist_2_12, 1080
.symver _sys_errlist_2_12, _sys_errlist@@GLIBC_2.12, remove
_sys_errlist_2_12: .fill 1080, 1, 0
.balign 8
.globl h_errlist_2_2_5
.type h_errlist_2_2_5, %object
.size h_errlist_2_2_5, 40
.symver h_errlist_2_2_5, h_errlist@@GLIBC_2.2.5, remove
h_errlist_2_2_5: .fill 40, 1, 0
.balign 8
.globl __curbrk_2_2_5
.type __curbrk_2_2_5, %object
.size __curbrk_2_2_5, 8
.symver __curbrk_2_2_5, __curbrk@@GLIBC_2.2.5, remove
__curbrk_2_2_5: .fill 8, 1, 0
.balign 8
.globl __key_gendes_LOCAL_2_2_5
.type __key_gendes_LOCAL_2_2_5, %object
.size __key_gendes_LOCAL_2_2_5, 8
.symver __key_gendes_LOCAL_2_2_5, __key_gendes_LOCAL@@GLIBC_2.2.5, remove
__key_gendes_LOCAL_2_2_5: .fill 8, 1, 0
.balign 8
.globl sys_nerr_2_4
.type sys_nerr_2_4, %object
.size sys_nerr_2_4, 4
.symver sys_nerr_2_4, sys_nerr@GLIBC_2.4, remove
sys_nerr_2_4: .fill 4, 1, 0
.balign 8
.globl sys_nerr_2_12
.type sys_nerr_2_12, %object
.size sys_nerr_2_12, 4
.symver sys_nerr_2_12, sys_nerr@@GLIBC_2.12, remove
sys_nerr_2_12: .fill 4, 1, 0
.balign 8
.globl sys_nerr_2_2_5
.type sys_nerr_2_2_5, %object
.size sys_nerr_2_2_5, 4
.symver sys_nerr_2_2_5, sys_nerr@GLIBC_2.2.5, remove
sys_nerr_2_2_5: .fill 4, 1, 0
.balign 8
.globl sys_nerr_2_3
.type sys_nerr_2_3, %object
.size sys_nerr_2_3, 4
.symver sys_nerr_2_3, sys_nerr@GLIBC_2.3, remove
sys_nerr_2_3: .fill 4, 1, 0
.balign 8
.globl re_max_failures_2_2_5
.type re_max_failures_2_2_5, %object
.size re_max_failures_2_2_5, 4
.symver re_max_failures_2_2_5, re_max_failures@@GLIBC_2.2.5, remove
re_max_failures_2_2_5: .fill 4, 1, 0
.balign 8
.globl re_syntax_options_2_2_5
.type re_syntax_options_2_2_5, %object
.size re_syntax_options_2_2_5, 8
.symver re_syntax_options_2_2_5, re_syntax_options@@GLIBC_2.2.5, remove
re_syntax_options_2_2_5: .fill 8, 1, 0
.balign 8
.globl h_nerr_2_2_5
.type h_nerr_2_2_5, %object
.size h_nerr_2_2_5, 4
.symver h_nerr_2_2_5, h_nerr@@GLIBC_2.2.5, remove
h_nerr_2_2_5: .fill 4, 1, 0
.balign 8
.globl sys_errlist_2_2_5
.type sys_errlist_2_2_5, %object
.size sys_errlist_2_2_5, 1000
.symver sys_errlist_2_2_5, sys_errlist@GLIBC_2.2.5, remove
sys_errlist_2_2_5: .fill 1000, 1, 0
.balign 8
.globl sys_errlist_2_3
.type sys_errlist_2_3, %object
.size sys_errlist_2_3, 1008
.symver sys_errlist_2_3, sys_errlist@GLIBC_2.3, remove
sys_errlist_2_3: .fill 1008, 1, 0
.balign 8
.globl sys_errlist_2_4
.type sys_errlist_2_4, %object
.size sys_errlist_2_4, 1056
.symver sys_errlist_2_4, sys_errlist@GLIBC_2.4, remove
sys_errlist_2_4: .fill 1056, 1, 0
.balign 8
.globl sys_errlist_2_12
.type sys_errlist_2_12, %object
.size sys_errlist_2_12, 1080
.symver sys_errlist_2_12, sys_errlist@@GLIBC_2.12, remove
sys_errlist_2_12: .fill 1080, 1, 0
.balign 8
.globl __ctype_toupper_2_2_5
.type __ctype_toupper_2_2_5, %object
.size __ctype_toupper_2_2_5, 8
.symver __ctype_toupper_2_2_5, __ctype_toupper@@GLIBC_2.2.5, remove
__ctype_toupper_2_2_5: .fill 8, 1, 0
.balign 8
.globl __timezone_2_2_5
.type __timezone_2_2_5, %object
.size __timezone_2_2_5, 8
.symver __timezone_2_2_5, __timezone@@GLIBC_2.2.5, remove
__timezone_2_2_5: .fill 8, 1, 0
.balign 8
.globl __key_encryptsession_pk_LOCAL_2_2_5
.type __key_encryptsession_pk_LOCAL_2_2_5, %object
.size __key_encryptsession_pk_LOCAL_2_2_5, 8
.symver __key_encryptsession_pk_LOCAL_2_2_5, __key_encryptsession_pk_LOCAL@@GLIBC_2.2.5, remove
__key_encryptsession_pk_LOCAL_2_2_5: .fill 8, 1, 0
.balign 8
.globl __realloc_hook_2_2_5
.type __realloc_hook_2_2_5, %object
.size __realloc_hook_2_2_5, 8
.symver __realloc_hook_2_2_5, __realloc_hook@@GLIBC_2.2.5, remove
__realloc_hook_2_2_5: .fill 8, 1, 0
.balign 8
.globl __ctype32_b_2_2_5
.type __ctype32_b_2_2_5, %object
.size __ctype32_b_2_2_5, 8
.symver __ctype32_b_2_2_5, __ctype32_b@@GLIBC_2.2.5, remove
__ctype32_b_2_2_5: .fill 8, 1, 0
.balign 8
.globl optarg_2_2_5
.type optarg_2_2_5, %object
.size optarg_2_2_5, 8
.symver optarg_2_2_5, optarg@@GLIBC_2.2.5, remove
optarg_2_2_5: .fill 8, 1, 0
.balign 8
.globl _nl_domain_bindings_2_2_5
.type _nl_domain_bindings_2_2_5, %object
.size _nl_domain_bindings_2_2_5, 8
.symver _nl_domain_bindings_2_2_5, _nl_domain_bindings@@GLIBC_2.2.5, remove
_nl_domain_bindings_2_2_5: .fill 8, 1, 0
.balign 8
.globl loc2_2_2_5
.type loc2_2_2_5, %object
.size loc2_2_2_5, 8
.symver loc2_2_2_5, loc2@@GLIBC_2.2.5, remove
loc2_2_2_5: .fill 8, 1, 0
.balign 8
.globl svcauthdes_stats_2_2_5
.type svcauthdes_stats_2_2_5, %object
.size svcauthdes_stats_2_2_5, 24
.symver svcauthdes_stats_2_2_5, svcauthdes_stats@@GLIBC_2.2.5, remove
svcauthdes_stats_2_2_5: .fill 24, 1, 0
.balign 8
.globl stdin_2_2_5
.type stdin_2_2_5, %object
.size stdin_2_2_5, 8
.symver stdin_2_2_5, stdin@@GLIBC_2.2.5, remove
stdin_2_2_5: .fill 8, 1, 0
.balign 8
.globl _IO_2_1_stderr__2_2_5
.type _IO_2_1_stderr__2_2_5, %object
.size _IO_2_1_stderr__2_2_5, 224
.symver _IO_2_1_stderr__2_2_5, _IO_2_1_stderr_@@GLIBC_2.2.5, remove
_IO_2_1_stderr__2_2_5: .fill 224, 1, 0
.balign 8
.globl optind_2_2_5
.type optind_2_2_5, %object
.size optind_2_2_5, 4
.symver optind_2_2_5, optind@@GLIBC_2.2.5, remove
optind_2_2_5: .fill 4, 1, 0
.balign 8
.globl __morecore_2_2_5
.type __morecore_2_2_5, %object
.size __morecore_2_2_5, 8
.symver __morecore_2_2_5, __morecore@@GLIBC_2.2.5, remove
__morecore_2_2_5: .fill 8, 1, 0
.balign 8
.globl error_message_count_2_2_5
.type error_message_count_2_2_5, %object
.size error_message_count_2_2_5, 4
.symver error_message_count_2_2_5, error_message_count@@GLIBC_2.2.5, remove
error_message_count_2_2_5: .fill 4, 1, 0
.balign 8
.globl stdout_2_2_5
.type stdout_2_2_5, %object
.size stdout_2_2_5, 8
.symver stdout_2_2_5, stdout@@GLIBC_2.2.5, remove
stdout_2_2_5: .fill 8, 1, 0
.balign 8
.globl timezone_2_2_5
.type timezone_2_2_5, %object
.size timezone_2_2_5, 8
.symver timezone_2_2_5, timezone@@GLIBC_2.2.5, remove
timezone_2_2_5: .fill 8, 1, 0
.balign 8
.globl __progname_full_2_2_5
.type __progname_full_2_2_5, %object
.size __progname_full_2_2_5, 8
.symver __progname_full_2_2_5, __progname_full@@GLIBC_2.2.5, remove
__progname_full_2_2_5: .fill 8, 1, 0
.balign 8
.globl _null_auth_2_2_5
.type _null_auth_2_2_5, %object
.size _null_auth_2_2_5, 24
.symver _null_auth_2_2_5, _null_auth@@GLIBC_2.2.5, remove
_null_auth_2_2_5: .fill 24, 1, 0
.balign 8
.globl __malloc_initialize_hook_2_2_5
.type __malloc_initialize_hook_2_2_5, %object
.size __malloc_initialize_hook_2_2_5, 8
.symver __malloc_initialize_hook_2_2_5, __malloc_initialize_hook@@GLIBC_2.2.5, remove
__malloc_initialize_hook_2_2_5: .fill 8, 1, 0
.balign 8
.globl _nl_default_dirname_2_2_5
.type _nl_default_dirname_2_2_5, %object
.size _nl_default_dirname_2_2_5, 18
.symver _nl_default_dirname_2_2_5, _nl_default_dirname@@GLIBC_2.2.5, remove
_nl_default_dirname_2_2_5: .fill 18, 1, 0
.balign 8
.globl _IO_2_1_stdout__2_2_5
.type _IO_2_1_stdout__2_2_5, %object
.size _IO_2_1_stdout__2_2_5, 224
.symver _IO_2_1_stdout__2_2_5, _IO_2_1_stdout_@@GLIBC_2.2.5, remove
_IO_2_1_stdout__2_2_5: .fill 224, 1, 0
.balign 8
.globl rpc_createerr_2_2_5
.type rpc_createerr_2_2_5, %object
.size rpc_createerr_2_2_5, 32
.symver rpc_createerr_2_2_5, rpc_createerr@@GLIBC_2.2.5, remove
rpc_createerr_2_2_5: .fill 32, 1, 0
.balign 8
.globl _res_hconf_2_2_5
.type _res_hconf_2_2_5, %object
.size _res_hconf_2_2_5, 72
.symver _res_hconf_2_2_5, _res_hconf@@GLIBC_2.2.5, remove
_res_hconf_2_2_5: .fill 72, 1, 0
.balign 8
.globl _IO_list_all_2_2_5
.type _IO_list_all_2_2_5, %object
.size _IO_list_all_2_2_5, 8
.symver _IO_list_all_2_2_5, _IO_list_all@@GLIBC_2.2.5, remove
_IO_list_all_2_2_5: .fill 8, 1, 0
.balign 8
.globl loc1_2_2_5
.type loc1_2_2_5, %object
.size loc1_2_2_5, 8
.symver loc1_2_2_5, loc1@@GLIBC_2.2.5, remove
loc1_2_2_5: .fill 8, 1, 0
.balign 8
.globl stderr_2_2_5
.type stderr_2_2_5, %object
.size stderr_2_2_5, 8
.symver stderr_2_2_5, stderr@@GLIBC_2.2.5, remove
stderr_2_2_5: .fill 8, 1, 0
.balign 8
.globl svc_pollfd_2_2_5
.type svc_pollfd_2_2_5, %object
.size svc_pollfd_2_2_5, 8
.symver svc_pollfd_2_2_5, svc_pollfd@@GLIBC_2.2.5, remove
svc_pollfd_2_2_5: .fill 8, 1, 0
.balign 8
.globl __malloc_hook_2_2_5
.type __malloc_hook_2_2_5, %object
.size __malloc_hook_2_2_5, 8
.symver __malloc_hook_2_2_5, __malloc_hook@@GLIBC_2.2.5, remove
__malloc_hook_2_2_5: .fill 8, 1, 0
.balign 8
.globl _IO_2_1_stdin__2_2_5
.type _IO_2_1_stdin__2_2_5, %object
.size _IO_2_1_stdin__2_2_5, 224
.symver _IO_2_1_stdin__2_2_5, _IO_2_1_stdin_@@GLIBC_2.2.5, remove
_IO_2_1_stdin__2_2_5: .fill 224, 1, 0
