.text
.balign 8
.globl remainderl_2_2_5
.type remainderl_2_2_5, %function
.symver remainderl_2_2_5, remainderl@@GLIBC_2.2.5, remove
remainderl_2_2_5: .quad 0
.balign 8
.globl tanhl_2_2_5
.type tanhl_2_2_5, %function
.symver tanhl_2_2_5, tanhl@@GLIBC_2.2.5, remove
tanhl_2_2_5: .quad 0
.balign 8
.globl __coshl_finite_2_15
.type __coshl_finite_2_15, %function
.symver __coshl_finite_2_15, __coshl_finite@@GLIBC_2.15, remove
__coshl_finite_2_15: .quad 0
.balign 8
.globl y1f_2_2_5
.type y1f_2_2_5, %function
.symver y1f_2_2_5, y1f@@GLIBC_2.2.5, remove
y1f_2_2_5: .quad 0
.balign 8
.globl fmaxl_2_2_5
.type fmaxl_2_2_5, %function
.symver fmaxl_2_2_5, fmaxl@@GLIBC_2.2.5, remove
fmaxl_2_2_5: .quad 0
.balign 8
.globl __acosf_finite_2_15
.type __acosf_finite_2_15, %function
.symver __acosf_finite_2_15, __acosf_finite@@GLIBC_2.15, remove
__acosf_finite_2_15: .quad 0
.balign 8
.globl __pow_finite_2_15
.type __pow_finite_2_15, %function
.symver __pow_finite_2_15, __pow_finite@@GLIBC_2.15, remove
__pow_finite_2_15: .quad 0
.balign 8
.globl __j0l_finite_2_15
.type __j0l_finite_2_15, %function
.symver __j0l_finite_2_15, __j0l_finite@@GLIBC_2.15, remove
__j0l_finite_2_15: .quad 0
.balign 8
.globl __sinh_finite_2_15
.type __sinh_finite_2_15, %function
.symver __sinh_finite_2_15, __sinh_finite@@GLIBC_2.15, remove
__sinh_finite_2_15: .quad 0
.balign 8
.globl ynl_2_2_5
.type ynl_2_2_5, %function
.symver ynl_2_2_5, ynl@@GLIBC_2.2.5, remove
ynl_2_2_5: .quad 0
.balign 8
.globl __powf_finite_2_15
.type __powf_finite_2_15, %function
.symver __powf_finite_2_15, __powf_finite@@GLIBC_2.15, remove
__powf_finite_2_15: .quad 0
.balign 8
.globl cargf_2_2_5
.type cargf_2_2_5, %function
.symver cargf_2_2_5, cargf@@GLIBC_2.2.5, remove
cargf_2_2_5: .quad 0
.balign 8
.globl erff_2_2_5
.type erff_2_2_5, %function
.symver erff_2_2_5, erff@@GLIBC_2.2.5, remove
erff_2_2_5: .quad 0
.balign 8
.globl lgammaf_r_2_2_5
.type lgammaf_r_2_2_5, %function
.symver lgammaf_r_2_2_5, lgammaf_r@@GLIBC_2.2.5, remove
lgammaf_r_2_2_5: .quad 0
.balign 8
.globl nextafterf_2_2_5
.type nextafterf_2_2_5, %function
.symver nextafterf_2_2_5, nextafterf@@GLIBC_2.2.5, remove
nextafterf_2_2_5: .quad 0
.balign 8
.globl sqrtl_2_2_5
.type sqrtl_2_2_5, %function
.symver sqrtl_2_2_5, sqrtl@@GLIBC_2.2.5, remove
sqrtl_2_2_5: .quad 0
.balign 8
.globl tan_2_2_5
.type tan_2_2_5, %function
.symver tan_2_2_5, tan@@GLIBC_2.2.5, remove
tan_2_2_5: .quad 0
.balign 8
.globl fesetexceptflag_2_2_5
.type fesetexceptflag_2_2_5, %function
.symver fesetexceptflag_2_2_5, fesetexceptflag@@GLIBC_2.2.5, remove
fesetexceptflag_2_2_5: .quad 0
.balign 8
.globl copysignf_2_2_5
.type copysignf_2_2_5, %function
.symver copysignf_2_2_5, copysignf@@GLIBC_2.2.5, remove
copysignf_2_2_5: .quad 0
.balign 8
.globl __y1f_finite_2_15
.type __y1f_finite_2_15, %function
.symver __y1f_finite_2_15, __y1f_finite@@GLIBC_2.15, remove
__y1f_finite_2_15: .quad 0
.balign 8
.globl logl_2_2_5
.type logl_2_2_5, %function
.symver logl_2_2_5, logl@@GLIBC_2.2.5, remove
logl_2_2_5: .quad 0
.balign 8
.globl nexttowardf_2_2_5
.type nexttowardf_2_2_5, %function
.symver nexttowardf_2_2_5, nexttowardf@@GLIBC_2.2.5, remove
nexttowardf_2_2_5: .quad 0
.balign 8
.globl fesetenv_2_2_5
.type fesetenv_2_2_5, %function
.symver fesetenv_2_2_5, fesetenv@@GLIBC_2.2.5, remove
fesetenv_2_2_5: .quad 0
.balign 8
.globl __signbitf_2_2_5
.type __signbitf_2_2_5, %function
.symver __signbitf_2_2_5, __signbitf@@GLIBC_2.2.5, remove
__signbitf_2_2_5: .quad 0
.balign 8
.globl cimagl_2_2_5
.type cimagl_2_2_5, %function
.symver cimagl_2_2_5, cimagl@@GLIBC_2.2.5, remove
cimagl_2_2_5: .quad 0
.balign 8
.globl powf_2_2_5
.type powf_2_2_5, %function
.symver powf_2_2_5, powf@@GLIBC_2.2.5, remove
powf_2_2_5: .quad 0
.balign 8
.globl ceilf_2_2_5
.type ceilf_2_2_5, %function
.symver ceilf_2_2_5, ceilf@@GLIBC_2.2.5, remove
ceilf_2_2_5: .quad 0
.balign 8
.globl __asin_finite_2_15
.type __asin_finite_2_15, %function
.symver __asin_finite_2_15, __asin_finite@@GLIBC_2.15, remove
__asin_finite_2_15: .quad 0
.balign 8
.globl fegetexceptflag_2_2_5
.type fegetexceptflag_2_2_5, %function
.symver fegetexceptflag_2_2_5, fegetexceptflag@@GLIBC_2.2.5, remove
fegetexceptflag_2_2_5: .quad 0
.balign 8
.globl logbl_2_2_5
.type logbl_2_2_5, %function
.symver logbl_2_2_5, logbl@@GLIBC_2.2.5, remove
logbl_2_2_5: .quad 0
.balign 8
.globl __logl_finite_2_15
.type __logl_finite_2_15, %function
.symver __logl_finite_2_15, __logl_finite@@GLIBC_2.15, remove
__logl_finite_2_15: .quad 0
.balign 8
.globl fdimf_2_2_5
.type fdimf_2_2_5, %function
.symver fdimf_2_2_5, fdimf@@GLIBC_2.2.5, remove
fdimf_2_2_5: .quad 0
.balign 8
.globl nearbyint_2_2_5
.type nearbyint_2_2_5, %function
.symver nearbyint_2_2_5, nearbyint@@GLIBC_2.2.5, remove
nearbyint_2_2_5: .quad 0
.balign 8
.globl __jnl_finite_2_15
.type __jnl_finite_2_15, %function
.symver __jnl_finite_2_15, __jnl_finite@@GLIBC_2.15, remove
__jnl_finite_2_15: .quad 0
.balign 8
.globl rint_2_2_5
.type rint_2_2_5, %function
.symver rint_2_2_5, rint@@GLIBC_2.2.5, remove
rint_2_2_5: .quad 0
.balign 8
.globl exp_2_2_5
.type exp_2_2_5, %function
.symver exp_2_2_5, exp@@GLIBC_2.2.5, remove
exp_2_2_5: .quad 0
.balign 8
.globl y0f_2_2_5
.type y0f_2_2_5, %function
.symver y0f_2_2_5, y0f@@GLIBC_2.2.5, remove
y0f_2_2_5: .quad 0
.balign 8
.globl __hypotf_finite_2_15
.type __hypotf_finite_2_15, %function
.symver __hypotf_finite_2_15, __hypotf_finite@@GLIBC_2.15, remove
__hypotf_finite_2_15: .quad 0
.balign 8
.globl tanh_2_2_5
.type tanh_2_2_5, %function
.symver tanh_2_2_5, tanh@@GLIBC_2.2.5, remove
tanh_2_2_5: .quad 0
.balign 8
.globl jn_2_2_5
.type jn_2_2_5, %function
.symver jn_2_2_5, jn@@GLIBC_2.2.5, remove
jn_2_2_5: .quad 0
.balign 8
.globl feclearexcept_2_2_5
.type feclearexcept_2_2_5, %function
.symver feclearexcept_2_2_5, feclearexcept@@GLIBC_2.2.5, remove
feclearexcept_2_2_5: .quad 0
.balign 8
.globl csinf_2_2_5
.type csinf_2_2_5, %function
.symver csinf_2_2_5, csinf@@GLIBC_2.2.5, remove
csinf_2_2_5: .quad 0
.balign 8
.globl modfl_2_2_5
.type modfl_2_2_5, %function
.symver modfl_2_2_5, modfl@@GLIBC_2.2.5, remove
modfl_2_2_5: .quad 0
.balign 8
.globl atanl_2_2_5
.type atanl_2_2_5, %function
.symver atanl_2_2_5, atanl@@GLIBC_2.2.5, remove
atanl_2_2_5: .quad 0
.balign 8
.globl __j1l_finite_2_15
.type __j1l_finite_2_15, %function
.symver __j1l_finite_2_15, __j1l_finite@@GLIBC_2.15, remove
__j1l_finite_2_15: .quad 0
.balign 8
.globl truncf_2_2_5
.type truncf_2_2_5, %function
.symver truncf_2_2_5, truncf@@GLIBC_2.2.5, remove
truncf_2_2_5: .quad 0
.balign 8
.globl j1_2_2_5
.type j1_2_2_5, %function
.symver j1_2_2_5, j1@@GLIBC_2.2.5, remove
j1_2_2_5: .quad 0
.balign 8
.globl trunc_2_2_5
.type trunc_2_2_5, %function
.symver trunc_2_2_5, trunc@@GLIBC_2.2.5, remove
trunc_2_2_5: .quad 0
.balign 8
.globl __atan2f_finite_2_15
.type __atan2f_finite_2_15, %function
.symver __atan2f_finite_2_15, __atan2f_finite@@GLIBC_2.15, remove
__atan2f_finite_2_15: .quad 0
.balign 8
.globl finitel_2_2_5
.type finitel_2_2_5, %function
.symver finitel_2_2_5, finitel@@GLIBC_2.2.5, remove
finitel_2_2_5: .quad 0
.balign 8
.globl log1p_2_2_5
.type log1p_2_2_5, %function
.symver log1p_2_2_5, log1p@@GLIBC_2.2.5, remove
log1p_2_2_5: .quad 0
.balign 8
.globl gammaf_2_2_5
.type gammaf_2_2_5, %function
.symver gammaf_2_2_5, gammaf@@GLIBC_2.2.5, remove
gammaf_2_2_5: .quad 0
.balign 8
.globl __y1_finite_2_15
.type __y1_finite_2_15, %function
.symver __y1_finite_2_15, __y1_finite@@GLIBC_2.15, remove
__y1_finite_2_15: .quad 0
.balign 8
.globl gamma_2_2_5
.type gamma_2_2_5, %function
.symver gamma_2_2_5, gamma@@GLIBC_2.2.5, remove
gamma_2_2_5: .quad 0
.balign 8
.globl sinl_2_2_5
.type sinl_2_2_5, %function
.symver sinl_2_2_5, sinl@@GLIBC_2.2.5, remove
sinl_2_2_5: .quad 0
.balign 8
.globl __scalb_finite_2_15
.type __scalb_finite_2_15, %function
.symver __scalb_finite_2_15, __scalb_finite@@GLIBC_2.15, remove
__scalb_finite_2_15: .quad 0
.balign 8
.globl hypotl_2_2_5
.type hypotl_2_2_5, %function
.symver hypotl_2_2_5, hypotl@@GLIBC_2.2.5, remove
hypotl_2_2_5: .quad 0
.balign 8
.globl clogf_2_2_5
.type clogf_2_2_5, %function
.symver clogf_2_2_5, clogf@@GLIBC_2.2.5, remove
clogf_2_2_5: .quad 0
.balign 8
.globl log10f_2_2_5
.type log10f_2_2_5, %function
.symver log10f_2_2_5, log10f@@GLIBC_2.2.5, remove
log10f_2_2_5: .quad 0
.balign 8
.globl __exp10f_finite_2_15
.type __exp10f_finite_2_15, %function
.symver __exp10f_finite_2_15, __exp10f_finite@@GLIBC_2.15, remove
__exp10f_finite_2_15: .quad 0
.balign 8
.globl cabsl_2_2_5
.type cabsl_2_2_5, %function
.symver cabsl_2_2_5, cabsl@@GLIBC_2.2.5, remove
cabsl_2_2_5: .quad 0
.balign 8
.globl expf_2_2_5
.type expf_2_2_5, %function
.symver expf_2_2_5, expf@@GLIBC_2.2.5, remove
expf_2_2_5: .quad 0
.balign 8
.globl remquof_2_2_5
.type remquof_2_2_5, %function
.symver remquof_2_2_5, remquof@@GLIBC_2.2.5, remove
remquof_2_2_5: .quad 0
.balign 8
.globl erfc_2_2_5
.type erfc_2_2_5, %function
.symver erfc_2_2_5, erfc@@GLIBC_2.2.5, remove
erfc_2_2_5: .quad 0
.balign 8
.globl expl_2_2_5
.type expl_2_2_5, %function
.symver expl_2_2_5, expl@@GLIBC_2.2.5, remove
expl_2_2_5: .quad 0
.balign 8
.globl __y0f_finite_2_15
.type __y0f_finite_2_15, %function
.symver __y0f_finite_2_15, __y0f_finite@@GLIBC_2.15, remove
__y0f_finite_2_15: .quad 0
.balign 8
.globl tgammaf_2_2_5
.type tgammaf_2_2_5, %function
.symver tgammaf_2_2_5, tgammaf@@GLIBC_2.2.5, remove
tgammaf_2_2_5: .quad 0
.balign 8
.globl atanh_2_2_5
.type atanh_2_2_5, %function
.symver atanh_2_2_5, atanh@@GLIBC_2.2.5, remove
atanh_2_2_5: .quad 0
.balign 8
.globl tanf_2_2_5
.type tanf_2_2_5, %function
.symver tanf_2_2_5, tanf@@GLIBC_2.2.5, remove
tanf_2_2_5: .quad 0
.balign 8
.globl j1f_2_2_5
.type j1f_2_2_5, %function
.symver j1f_2_2_5, j1f@@GLIBC_2.2.5, remove
j1f_2_2_5: .quad 0
.balign 8
.globl cexpl_2_2_5
.type cexpl_2_2_5, %function
.symver cexpl_2_2_5, cexpl@@GLIBC_2.2.5, remove
cexpl_2_2_5: .quad 0
.balign 8
.globl cprojl_2_2_5
.type cprojl_2_2_5, %function
.symver cprojl_2_2_5, cprojl@@GLIBC_2.2.5, remove
cprojl_2_2_5: .quad 0
.balign 8
.globl cacosf_2_2_5
.type cacosf_2_2_5, %function
.symver cacosf_2_2_5, cacosf@@GLIBC_2.2.5, remove
cacosf_2_2_5: .quad 0
.balign 8
.globl casinl_2_2_5
.type casinl_2_2_5, %function
.symver casinl_2_2_5, casinl@@GLIBC_2.2.5, remove
casinl_2_2_5: .quad 0
.balign 8
.globl nexttoward_2_2_5
.type nexttoward_2_2_5, %function
.symver nexttoward_2_2_5, nexttoward@@GLIBC_2.2.5, remove
nexttoward_2_2_5: .quad 0
.balign 8
.globl cosh_2_2_5
.type cosh_2_2_5, %function
.symver cosh_2_2_5, cosh@@GLIBC_2.2.5, remove
cosh_2_2_5: .quad 0
.balign 8
.globl frexp_2_2_5
.type frexp_2_2_5, %function
.symver frexp_2_2_5, frexp@@GLIBC_2.2.5, remove
frexp_2_2_5: .quad 0
.balign 8
.globl fma_2_2_5
.type fma_2_2_5, %function
.symver fma_2_2_5, fma@@GLIBC_2.2.5, remove
fma_2_2_5: .quad 0
.balign 8
.globl frexpl_2_2_5
.type frexpl_2_2_5, %function
.symver frexpl_2_2_5, frexpl@@GLIBC_2.2.5, remove
frexpl_2_2_5: .quad 0
.balign 8
.globl j0_2_2_5
.type j0_2_2_5, %function
.symver j0_2_2_5, j0@@GLIBC_2.2.5, remove
j0_2_2_5: .quad 0
.balign 8
.globl catanhl_2_2_5
.type catanhl_2_2_5, %function
.symver catanhl_2_2_5, catanhl@@GLIBC_2.2.5, remove
catanhl_2_2_5: .quad 0
.balign 8
.globl cimag_2_2_5
.type cimag_2_2_5, %function
.symver cimag_2_2_5, cimag@@GLIBC_2.2.5, remove
cimag_2_2_5: .quad 0
.balign 8
.globl nanf_2_2_5
.type nanf_2_2_5, %function
.symver nanf_2_2_5, nanf@@GLIBC_2.2.5, remove
nanf_2_2_5: .quad 0
.balign 8
.globl casinh_2_2_5
.type casinh_2_2_5, %function
.symver casinh_2_2_5, casinh@@GLIBC_2.2.5, remove
casinh_2_2_5: .quad 0
.balign 8
.globl ccosl_2_2_5
.type ccosl_2_2_5, %function
.symver ccosl_2_2_5, ccosl@@GLIBC_2.2.5, remove
ccosl_2_2_5: .quad 0
.balign 8
.globl ldexpl_2_2_5
.type ldexpl_2_2_5, %function
.symver ldexpl_2_2_5, ldexpl@@GLIBC_2.2.5, remove
ldexpl_2_2_5: .quad 0
.balign 8
.globl catanh_2_2_5
.type catanh_2_2_5, %function
.symver catanh_2_2_5, catanh@@GLIBC_2.2.5, remove
catanh_2_2_5: .quad 0
.balign 8
.globl ceil_2_2_5
.type ceil_2_2_5, %function
.symver ceil_2_2_5, ceil@@GLIBC_2.2.5, remove
ceil_2_2_5: .quad 0
.balign 8
.globl csqrt_2_2_5
.type csqrt_2_2_5, %function
.symver csqrt_2_2_5, csqrt@@GLIBC_2.2.5, remove
csqrt_2_2_5: .quad 0
.balign 8
.globl ceill_2_2_5
.type ceill_2_2_5, %function
.symver ceill_2_2_5, ceill@@GLIBC_2.2.5, remove
ceill_2_2_5: .quad 0
.balign 8
.globl __exp_finite_2_15
.type __exp_finite_2_15, %function
.symver __exp_finite_2_15, __exp_finite@@GLIBC_2.15, remove
__exp_finite_2_15: .quad 0
.balign 8
.globl casinhl_2_2_5
.type casinhl_2_2_5, %function
.symver casinhl_2_2_5, casinhl@@GLIBC_2.2.5, remove
casinhl_2_2_5: .quad 0
.balign 8
.globl fegetround_2_2_5
.type fegetround_2_2_5, %function
.symver fegetround_2_2_5, fegetround@@GLIBC_2.2.5, remove
fegetround_2_2_5: .quad 0
.balign 8
.globl __lgammal_r_finite_2_15
.type __lgammal_r_finite_2_15, %function
.symver __lgammal_r_finite_2_15, __lgammal_r_finite@@GLIBC_2.15, remove
__lgammal_r_finite_2_15: .quad 0
.balign 8
.globl __acos_finite_2_15
.type __acos_finite_2_15, %function
.symver __acos_finite_2_15, __acos_finite@@GLIBC_2.15, remove
__acos_finite_2_15: .quad 0
.balign 8
.globl casin_2_2_5
.type casin_2_2_5, %function
.symver casin_2_2_5, casin@@GLIBC_2.2.5, remove
casin_2_2_5: .quad 0
.balign 8
.globl casinf_2_2_5
.type casinf_2_2_5, %function
.symver casinf_2_2_5, casinf@@GLIBC_2.2.5, remove
casinf_2_2_5: .quad 0
.balign 8
.globl llround_2_2_5
.type llround_2_2_5, %function
.symver llround_2_2_5, llround@@GLIBC_2.2.5, remove
llround_2_2_5: .quad 0
.balign 8
.globl fdim_2_2_5
.type fdim_2_2_5, %function
.symver fdim_2_2_5, fdim@@GLIBC_2.2.5, remove
fdim_2_2_5: .quad 0
.balign 8
.globl conjf_2_2_5
.type conjf_2_2_5, %function
.symver conjf_2_2_5, conjf@@GLIBC_2.2.5, remove
conjf_2_2_5: .quad 0
.balign 8
.globl expm1l_2_2_5
.type expm1l_2_2_5, %function
.symver expm1l_2_2_5, expm1l@@GLIBC_2.2.5, remove
expm1l_2_2_5: .quad 0
.balign 8
.globl pow_2_2_5
.type pow_2_2_5, %function
.symver pow_2_2_5, pow@@GLIBC_2.2.5, remove
pow_2_2_5: .quad 0
.balign 8
.globl y0l_2_2_5
.type y0l_2_2_5, %function
.symver y0l_2_2_5, y0l@@GLIBC_2.2.5, remove
y0l_2_2_5: .quad 0
.balign 8
.globl hypot_2_2_5
.type hypot_2_2_5, %function
.symver hypot_2_2_5, hypot@@GLIBC_2.2.5, remove
hypot_2_2_5: .quad 0
.balign 8
.globl scalbn_2_2_5
.type scalbn_2_2_5, %function
.symver scalbn_2_2_5, scalbn@@GLIBC_2.2.5, remove
scalbn_2_2_5: .quad 0
.balign 8
.globl scalblnf_2_2_5
.type scalblnf_2_2_5, %function
.symver scalblnf_2_2_5, scalblnf@@GLIBC_2.2.5, remove
scalblnf_2_2_5: .quad 0
.balign 8
.globl ccoshl_2_2_5
.type ccoshl_2_2_5, %function
.symver ccoshl_2_2_5, ccoshl@@GLIBC_2.2.5, remove
ccoshl_2_2_5: .quad 0
.balign 8
.globl fedisableexcept_2_2_5
.type fedisableexcept_2_2_5, %function
.symver fedisableexcept_2_2_5, fedisableexcept@@GLIBC_2.2.5, remove
fedisableexcept_2_2_5: .quad 0
.balign 8
.globl fminf_2_2_5
.type fminf_2_2_5, %function
.symver fminf_2_2_5, fminf@@GLIBC_2.2.5, remove
fminf_2_2_5: .quad 0
.balign 8
.globl catanhf_2_2_5
.type catanhf_2_2_5, %function
.symver catanhf_2_2_5, catanhf@@GLIBC_2.2.5, remove
catanhf_2_2_5: .quad 0
.balign 8
.globl __lgammaf_r_finite_2_15
.type __lgammaf_r_finite_2_15, %function
.symver __lgammaf_r_finite_2_15, __lgammaf_r_finite@@GLIBC_2.15, remove
__lgammaf_r_finite_2_15: .quad 0
.balign 8
.globl cabsf_2_2_5
.type cabsf_2_2_5, %function
.symver cabsf_2_2_5, cabsf@@GLIBC_2.2.5, remove
cabsf_2_2_5: .quad 0
.balign 8
.globl exp10f_2_2_5
.type exp10f_2_2_5, %function
.symver exp10f_2_2_5, exp10f@@GLIBC_2.2.5, remove
exp10f_2_2_5: .quad 0
.balign 8
.globl lrintf_2_2_5
.type lrintf_2_2_5, %function
.symver lrintf_2_2_5, lrintf@@GLIBC_2.2.5, remove
lrintf_2_2_5: .quad 0
.balign 8
.globl catan_2_2_5
.type catan_2_2_5, %function
.symver catan_2_2_5, catan@@GLIBC_2.2.5, remove
catan_2_2_5: .quad 0
.balign 8
.globl csinl_2_2_5
.type csinl_2_2_5, %function
.symver csinl_2_2_5, csinl@@GLIBC_2.2.5, remove
csinl_2_2_5: .quad 0
.balign 8
.globl __log2_finite_2_15
.type __log2_finite_2_15, %function
.symver __log2_finite_2_15, __log2_finite@@GLIBC_2.15, remove
__log2_finite_2_15: .quad 0
.balign 8
.globl cpowl_2_2_5
.type cpowl_2_2_5, %function
.symver cpowl_2_2_5, cpowl@@GLIBC_2.2.5, remove
cpowl_2_2_5: .quad 0
.balign 8
.globl __acosl_finite_2_15
.type __acosl_finite_2_15, %function
.symver __acosl_finite_2_15, __acosl_finite@@GLIBC_2.15, remove
__acosl_finite_2_15: .quad 0
.balign 8
.globl fdiml_2_2_5
.type fdiml_2_2_5, %function
.symver fdiml_2_2_5, fdiml@@GLIBC_2.2.5, remove
fdiml_2_2_5: .quad 0
.balign 8
.globl __asinf_finite_2_15
.type __asinf_finite_2_15, %function
.symver __asinf_finite_2_15, __asinf_finite@@GLIBC_2.15, remove
__asinf_finite_2_15: .quad 0
.balign 8
.globl sinhl_2_2_5
.type sinhl_2_2_5, %function
.symver sinhl_2_2_5, sinhl@@GLIBC_2.2.5, remove
sinhl_2_2_5: .quad 0
.balign 8
.globl __expf_finite_2_15
.type __expf_finite_2_15, %function
.symver __expf_finite_2_15, __expf_finite@@GLIBC_2.15, remove
__expf_finite_2_15: .quad 0
.balign 8
.globl drem_2_2_5
.type drem_2_2_5, %function
.symver drem_2_2_5, drem@@GLIBC_2.2.5, remove
drem_2_2_5: .quad 0
.balign 8
.globl lround_2_2_5
.type lround_2_2_5, %function
.symver lround_2_2_5, lround@@GLIBC_2.2.5, remove
lround_2_2_5: .quad 0
.balign 8
.globl ccoshf_2_2_5
.type ccoshf_2_2_5, %function
.symver ccoshf_2_2_5, ccoshf@@GLIBC_2.2.5, remove
ccoshf_2_2_5: .quad 0
.balign 8
.globl matherr_2_2_5
.type matherr_2_2_5, %function
.symver matherr_2_2_5, matherr@@GLIBC_2.2.5, remove
matherr_2_2_5: .quad 0
.balign 8
.globl erfcl_2_2_5
.type erfcl_2_2_5, %function
.symver erfcl_2_2_5, erfcl@@GLIBC_2.2.5, remove
erfcl_2_2_5: .quad 0
.balign 8
.globl atan_2_2_5
.type atan_2_2_5, %function
.symver atan_2_2_5, atan@@GLIBC_2.2.5, remove
atan_2_2_5: .quad 0
.balign 8
.globl tanhf_2_2_5
.type tanhf_2_2_5, %function
.symver tanhf_2_2_5, tanhf@@GLIBC_2.2.5, remove
tanhf_2_2_5: .quad 0
.balign 8
.globl cpow_2_2_5
.type cpow_2_2_5, %function
.symver cpow_2_2_5, cpow@@GLIBC_2.2.5, remove
cpow_2_2_5: .quad 0
.balign 8
.globl cimagf_2_2_5
.type cimagf_2_2_5, %function
.symver cimagf_2_2_5, cimagf@@GLIBC_2.2.5, remove
cimagf_2_2_5: .quad 0
.balign 8
.globl csqrtf_2_2_5
.type csqrtf_2_2_5, %function
.symver csqrtf_2_2_5, csqrtf@@GLIBC_2.2.5, remove
csqrtf_2_2_5: .quad 0
.balign 8
.globl floorf_2_2_5
.type floorf_2_2_5, %function
.symver floorf_2_2_5, floorf@@GLIBC_2.2.5, remove
floorf_2_2_5: .quad 0
.balign 8
.globl __atanhl_finite_2_15
.type __atanhl_finite_2_15, %function
.symver __atanhl_finite_2_15, __atanhl_finite@@GLIBC_2.15, remove
__atanhl_finite_2_15: .quad 0
.balign 8
.globl asinl_2_2_5
.type asinl_2_2_5, %function
.symver asinl_2_2_5, asinl@@GLIBC_2.2.5, remove
asinl_2_2_5: .quad 0
.balign 8
.globl exp10_2_2_5
.type exp10_2_2_5, %function
.symver exp10_2_2_5, exp10@@GLIBC_2.2.5, remove
exp10_2_2_5: .quad 0
.balign 8
.globl cosf_2_2_5
.type cosf_2_2_5, %function
.symver cosf_2_2_5, cosf@@GLIBC_2.2.5, remove
cosf_2_2_5: .quad 0
.balign 8
.globl __log2f_finite_2_15
.type __log2f_finite_2_15, %function
.symver __log2f_finite_2_15, __log2f_finite@@GLIBC_2.15, remove
__log2f_finite_2_15: .quad 0
.balign 8
.globl fmax_2_2_5
.type fmax_2_2_5, %function
.symver fmax_2_2_5, fmax@@GLIBC_2.2.5, remove
fmax_2_2_5: .quad 0
.balign 8
.globl sincos_2_2_5
.type sincos_2_2_5, %function
.symver sincos_2_2_5, sincos@@GLIBC_2.2.5, remove
sincos_2_2_5: .quad 0
.balign 8
.globl log2f_2_2_5
.type log2f_2_2_5, %function
.symver log2f_2_2_5, log2f@@GLIBC_2.2.5, remove
log2f_2_2_5: .quad 0
.balign 8
.globl yn_2_2_5
.type yn_2_2_5, %function
.symver yn_2_2_5, yn@@GLIBC_2.2.5, remove
yn_2_2_5: .quad 0
.balign 8
.globl __fmodf_finite_2_15
.type __fmodf_finite_2_15, %function
.symver __fmodf_finite_2_15, __fmodf_finite@@GLIBC_2.15, remove
__fmodf_finite_2_15: .quad 0
.balign 8
.globl coshf_2_2_5
.type coshf_2_2_5, %function
.symver coshf_2_2_5, coshf@@GLIBC_2.2.5, remove
coshf_2_2_5: .quad 0
.balign 8
.globl creall_2_2_5
.type creall_2_2_5, %function
.symver creall_2_2_5, creall@@GLIBC_2.2.5, remove
creall_2_2_5: .quad 0
.balign 8
.globl fmal_2_2_5
.type fmal_2_2_5, %function
.symver fmal_2_2_5, fmal@@GLIBC_2.2.5, remove
fmal_2_2_5: .quad 0
.balign 8
.globl ldexpf_2_2_5
.type ldexpf_2_2_5, %function
.symver ldexpf_2_2_5, ldexpf@@GLIBC_2.2.5, remove
ldexpf_2_2_5: .quad 0
.balign 8
.globl jnf_2_2_5
.type jnf_2_2_5, %function
.symver jnf_2_2_5, jnf@@GLIBC_2.2.5, remove
jnf_2_2_5: .quad 0
.balign 8
.globl __sinhf_finite_2_15
.type __sinhf_finite_2_15, %function
.symver __sinhf_finite_2_15, __sinhf_finite@@GLIBC_2.15, remove
__sinhf_finite_2_15: .quad 0
.balign 8
.globl acoshl_2_2_5
.type acoshl_2_2_5, %function
.symver acoshl_2_2_5, acoshl@@GLIBC_2.2.5, remove
acoshl_2_2_5: .quad 0
.balign 8
.globl logf_2_2_5
.type logf_2_2_5, %function
.symver logf_2_2_5, logf@@GLIBC_2.2.5, remove
logf_2_2_5: .quad 0
.balign 8
.globl __jn_finite_2_15
.type __jn_finite_2_15, %function
.symver __jn_finite_2_15, __jn_finite@@GLIBC_2.15, remove
__jn_finite_2_15: .quad 0
.balign 8
.globl asinhf_2_2_5
.type asinhf_2_2_5, %function
.symver asinhf_2_2_5, asinhf@@GLIBC_2.2.5, remove
asinhf_2_2_5: .quad 0
.balign 8
.globl sinh_2_2_5
.type sinh_2_2_5, %function
.symver sinh_2_2_5, sinh@@GLIBC_2.2.5, remove
sinh_2_2_5: .quad 0
.balign 8
.globl acosl_2_2_5
.type acosl_2_2_5, %function
.symver acosl_2_2_5, acosl@@GLIBC_2.2.5, remove
acosl_2_2_5: .quad 0
.balign 8
.globl coshl_2_2_5
.type coshl_2_2_5, %function
.symver coshl_2_2_5, coshl@@GLIBC_2.2.5, remove
coshl_2_2_5: .quad 0
.balign 8
.globl __gammaf_r_finite_2_15
.type __gammaf_r_finite_2_15, %function
.symver __gammaf_r_finite_2_15, __gammaf_r_finite@@GLIBC_2.15, remove
__gammaf_r_finite_2_15: .quad 0
.balign 8
.globl __clog10l_2_2_5
.type __clog10l_2_2_5, %function
.symver __clog10l_2_2_5, __clog10l@@GLIBC_2.2.5, remove
__clog10l_2_2_5: .quad 0
.balign 8
.globl erf_2_2_5
.type erf_2_2_5, %function
.symver erf_2_2_5, erf@@GLIBC_2.2.5, remove
erf_2_2_5: .quad 0
.balign 8
.globl ldexp_2_2_5
.type ldexp_2_2_5, %function
.symver ldexp_2_2_5, ldexp@@GLIBC_2.2.5, remove
ldexp_2_2_5: .quad 0
.balign 8
.globl sinhf_2_2_5
.type sinhf_2_2_5, %function
.symver sinhf_2_2_5, sinhf@@GLIBC_2.2.5, remove
sinhf_2_2_5: .quad 0
.balign 8
.globl y1_2_2_5
.type y1_2_2_5, %function
.symver y1_2_2_5, y1@@GLIBC_2.2.5, remove
y1_2_2_5: .quad 0
.balign 8
.globl scalbnf_2_2_5
.type scalbnf_2_2_5, %function
.symver scalbnf_2_2_5, scalbnf@@GLIBC_2.2.5, remove
scalbnf_2_2_5: .quad 0
.balign 8
.globl __acosh_finite_2_15
.type __acosh_finite_2_15, %function
.symver __acosh_finite_2_15, __acosh_finite@@GLIBC_2.15, remove
__acosh_finite_2_15: .quad 0
.balign 8
.globl floorl_2_2_5
.type floorl_2_2_5, %function
.symver floorl_2_2_5, floorl@@GLIBC_2.2.5, remove
floorl_2_2_5: .quad 0
.balign 8
.globl __fpclassifyf_2_2_5
.type __fpclassifyf_2_2_5, %function
.symver __fpclassifyf_2_2_5, __fpclassifyf@@GLIBC_2.2.5, remove
__fpclassifyf_2_2_5: .quad 0
.balign 8
.globl ctanhf_2_2_5
.type ctanhf_2_2_5, %function
.symver ctanhf_2_2_5, ctanhf@@GLIBC_2.2.5, remove
ctanhf_2_2_5: .quad 0
.balign 8
.globl conj_2_2_5
.type conj_2_2_5, %function
.symver conj_2_2_5, conj@@GLIBC_2.2.5, remove
conj_2_2_5: .quad 0
.balign 8
.globl significand_2_2_5
.type significand_2_2_5, %function
.symver significand_2_2_5, significand@@GLIBC_2.2.5, remove
significand_2_2_5: .quad 0
.balign 8
.globl roundl_2_2_5
.type roundl_2_2_5, %function
.symver roundl_2_2_5, roundl@@GLIBC_2.2.5, remove
roundl_2_2_5: .quad 0
.balign 8
.globl cbrt_2_2_5
.type cbrt_2_2_5, %function
.symver cbrt_2_2_5, cbrt@@GLIBC_2.2.5, remove
cbrt_2_2_5: .quad 0
.balign 8
.globl fegetenv_2_2_5
.type fegetenv_2_2_5, %function
.symver fegetenv_2_2_5, fegetenv@@GLIBC_2.2.5, remove
fegetenv_2_2_5: .quad 0
.balign 8
.globl fesetround_2_2_5
.type fesetround_2_2_5, %function
.symver fesetround_2_2_5, fesetround@@GLIBC_2.2.5, remove
fesetround_2_2_5: .quad 0
.balign 8
.globl lgammal_r_2_2_5
.type lgammal_r_2_2_5, %function
.symver lgammal_r_2_2_5, lgammal_r@@GLIBC_2.2.5, remove
lgammal_r_2_2_5: .quad 0
.balign 8
.globl __atanhf_finite_2_15
.type __atanhf_finite_2_15, %function
.symver __atanhf_finite_2_15, __atanhf_finite@@GLIBC_2.15, remove
__atanhf_finite_2_15: .quad 0
.balign 8
.globl j0f_2_2_5
.type j0f_2_2_5, %function
.symver j0f_2_2_5, j0f@@GLIBC_2.2.5, remove
j0f_2_2_5: .quad 0
.balign 8
.globl csin_2_2_5
.type csin_2_2_5, %function
.symver csin_2_2_5, csin@@GLIBC_2.2.5, remove
csin_2_2_5: .quad 0
.balign 8
.globl nan_2_2_5
.type nan_2_2_5, %function
.symver nan_2_2_5, nan@@GLIBC_2.2.5, remove
nan_2_2_5: .quad 0
.balign 8
.globl expm1_2_2_5
.type expm1_2_2_5, %function
.symver expm1_2_2_5, expm1@@GLIBC_2.2.5, remove
expm1_2_2_5: .quad 0
.balign 8
.globl __yn_finite_2_15
.type __yn_finite_2_15, %function
.symver __yn_finite_2_15, __yn_finite@@GLIBC_2.15, remove
__yn_finite_2_15: .quad 0
.balign 8
.globl __j1_finite_2_15
.type __j1_finite_2_15, %function
.symver __j1_finite_2_15, __j1_finite@@GLIBC_2.15, remove
__j1_finite_2_15: .quad 0
.balign 8
.globl powl_2_2_5
.type powl_2_2_5, %function
.symver powl_2_2_5, powl@@GLIBC_2.2.5, remove
powl_2_2_5: .quad 0
.balign 8
.globl acosf_2_2_5
.type acosf_2_2_5, %function
.symver acosf_2_2_5, acosf@@GLIBC_2.2.5, remove
acosf_2_2_5: .quad 0
.balign 8
.globl cbrtf_2_2_5
.type cbrtf_2_2_5, %function
.symver cbrtf_2_2_5, cbrtf@@GLIBC_2.2.5, remove
cbrtf_2_2_5: .quad 0
.balign 8
.globl lrint_2_2_5
.type lrint_2_2_5, %function
.symver lrint_2_2_5, lrint@@GLIBC_2.2.5, remove
lrint_2_2_5: .quad 0
.balign 8
.globl __sqrtl_finite_2_15
.type __sqrtl_finite_2_15, %function
.symver __sqrtl_finite_2_15, __sqrtl_finite@@GLIBC_2.15, remove
__sqrtl_finite_2_15: .quad 0
.balign 8
.globl catanf_2_2_5
.type catanf_2_2_5, %function
.symver catanf_2_2_5, catanf@@GLIBC_2.2.5, remove
catanf_2_2_5: .quad 0
.balign 8
.globl __acoshl_finite_2_15
.type __acoshl_finite_2_15, %function
.symver __acoshl_finite_2_15, __acoshl_finite@@GLIBC_2.15, remove
__acoshl_finite_2_15: .quad 0
.balign 8
.globl cos_2_2_5
.type cos_2_2_5, %function
.symver cos_2_2_5, cos@@GLIBC_2.2.5, remove
cos_2_2_5: .quad 0
.balign 8
.globl lroundf_2_2_5
.type lroundf_2_2_5, %function
.symver lroundf_2_2_5, lroundf@@GLIBC_2.2.5, remove
lroundf_2_2_5: .quad 0
.balign 8
.globl log10l_2_2_5
.type log10l_2_2_5, %function
.symver log10l_2_2_5, log10l@@GLIBC_2.2.5, remove
log10l_2_2_5: .quad 0
.balign 8
.globl crealf_2_2_5
.type crealf_2_2_5, %function
.symver crealf_2_2_5, crealf@@GLIBC_2.2.5, remove
crealf_2_2_5: .quad 0
.balign 8
.globl j0l_2_2_5
.type j0l_2_2_5, %function
.symver j0l_2_2_5, j0l@@GLIBC_2.2.5, remove
j0l_2_2_5: .quad 0
.balign 8
.globl tgammal_2_2_5
.type tgammal_2_2_5, %function
.symver tgammal_2_2_5, tgammal@@GLIBC_2.2.5, remove
tgammal_2_2_5: .quad 0
.balign 8
.globl lrintl_2_2_5
.type lrintl_2_2_5, %function
.symver lrintl_2_2_5, lrintl@@GLIBC_2.2.5, remove
lrintl_2_2_5: .quad 0
.balign 8
.globl feraiseexcept_2_2_5
.type feraiseexcept_2_2_5, %function
.symver feraiseexcept_2_2_5, feraiseexcept@@GLIBC_2.2.5, remove
feraiseexcept_2_2_5: .quad 0
.balign 8
.globl feholdexcept_2_2_5
.type feholdexcept_2_2_5, %function
.symver feholdexcept_2_2_5, feholdexcept@@GLIBC_2.2.5, remove
feholdexcept_2_2_5: .quad 0
.balign 8
.globl scalbf_2_2_5
.type scalbf_2_2_5, %function
.symver scalbf_2_2_5, scalbf@@GLIBC_2.2.5, remove
scalbf_2_2_5: .quad 0
.balign 8
.globl atan2_2_2_5
.type atan2_2_2_5, %function
.symver atan2_2_2_5, atan2@@GLIBC_2.2.5, remove
atan2_2_2_5: .quad 0
.balign 8
.globl rintf_2_2_5
.type rintf_2_2_5, %function
.symver rintf_2_2_5, rintf@@GLIBC_2.2.5, remove
rintf_2_2_5: .quad 0
.balign 8
.globl cacoshf_2_2_5
.type cacoshf_2_2_5, %function
.symver cacoshf_2_2_5, cacoshf@@GLIBC_2.2.5, remove
cacoshf_2_2_5: .quad 0
.balign 8
.globl round_2_2_5
.type round_2_2_5, %function
.symver round_2_2_5, round@@GLIBC_2.2.5, remove
round_2_2_5: .quad 0
.balign 8
.globl exp10l_2_2_5
.type exp10l_2_2_5, %function
.symver exp10l_2_2_5, exp10l@@GLIBC_2.2.5, remove
exp10l_2_2_5: .quad 0
.balign 8
.globl __signbitl_2_2_5
.type __signbitl_2_2_5, %function
.symver __signbitl_2_2_5, __signbitl@@GLIBC_2.2.5, remove
__signbitl_2_2_5: .quad 0
.balign 8
.globl significandf_2_2_5
.type significandf_2_2_5, %function
.symver significandf_2_2_5, significandf@@GLIBC_2.2.5, remove
significandf_2_2_5: .quad 0
.balign 8
.globl scalblnl_2_2_5
.type scalblnl_2_2_5, %function
.symver scalblnl_2_2_5, scalblnl@@GLIBC_2.2.5, remove
scalblnl_2_2_5: .quad 0
.balign 8
.globl pow10f_2_2_5
.type pow10f_2_2_5, %function
.symver pow10f_2_2_5, pow10f@@GLIBC_2.2.5, remove
pow10f_2_2_5: .quad 0
.balign 8
.globl __exp10l_finite_2_15
.type __exp10l_finite_2_15, %function
.symver __exp10l_finite_2_15, __exp10l_finite@@GLIBC_2.15, remove
__exp10l_finite_2_15: .quad 0
.balign 8
.globl erfl_2_2_5
.type erfl_2_2_5, %function
.symver erfl_2_2_5, erfl@@GLIBC_2.2.5, remove
erfl_2_2_5: .quad 0
.balign 8
.globl tgamma_2_2_5
.type tgamma_2_2_5, %function
.symver tgamma_2_2_5, tgamma@@GLIBC_2.2.5, remove
tgamma_2_2_5: .quad 0
.balign 8
.globl fmodf_2_2_5
.type fmodf_2_2_5, %function
.symver fmodf_2_2_5, fmodf@@GLIBC_2.2.5, remove
fmodf_2_2_5: .quad 0
.balign 8
.globl llrintl_2_2_5
.type llrintl_2_2_5, %function
.symver llrintl_2_2_5, llrintl@@GLIBC_2.2.5, remove
llrintl_2_2_5: .quad 0
.balign 8
.globl feenableexcept_2_2_5
.type feenableexcept_2_2_5, %function
.symver feenableexcept_2_2_5, feenableexcept@@GLIBC_2.2.5, remove
feenableexcept_2_2_5: .quad 0
.balign 8
.globl __remainderl_finite_2_15
.type __remainderl_finite_2_15, %function
.symver __remainderl_finite_2_15, __remainderl_finite@@GLIBC_2.15, remove
__remainderl_finite_2_15: .quad 0
.balign 8
.globl fmaxf_2_2_5
.type fmaxf_2_2_5, %function
.symver fmaxf_2_2_5, fmaxf@@GLIBC_2.2.5, remove
fmaxf_2_2_5: .quad 0
.balign 8
.globl asinhl_2_2_5
.type asinhl_2_2_5, %function
.symver asinhl_2_2_5, asinhl@@GLIBC_2.2.5, remove
asinhl_2_2_5: .quad 0
.balign 8
.globl __ynl_finite_2_15
.type __ynl_finite_2_15, %function
.symver __ynl_finite_2_15, __ynl_finite@@GLIBC_2.15, remove
__ynl_finite_2_15: .quad 0
.balign 8
.globl catanl_2_2_5
.type catanl_2_2_5, %function
.symver catanl_2_2_5, catanl@@GLIBC_2.2.5, remove
catanl_2_2_5: .quad 0
.balign 8
.globl log2_2_2_5
.type log2_2_2_5, %function
.symver log2_2_2_5, log2@@GLIBC_2.2.5, remove
log2_2_2_5: .quad 0
.balign 8
.globl acoshf_2_2_5
.type acoshf_2_2_5, %function
.symver acoshf_2_2_5, acoshf@@GLIBC_2.2.5, remove
acoshf_2_2_5: .quad 0
.balign 8
.globl ccosh_2_2_5
.type ccosh_2_2_5, %function
.symver ccosh_2_2_5, ccosh@@GLIBC_2.2.5, remove
ccosh_2_2_5: .quad 0
.balign 8
.globl acosh_2_2_5
.type acosh_2_2_5, %function
.symver acosh_2_2_5, acosh@@GLIBC_2.2.5, remove
acosh_2_2_5: .quad 0
.balign 8
.globl log10_2_2_5
.type log10_2_2_5, %function
.symver log10_2_2_5, log10@@GLIBC_2.2.5, remove
log10_2_2_5: .quad 0
.balign 8
.globl fegetexcept_2_2_5
.type fegetexcept_2_2_5, %function
.symver fegetexcept_2_2_5, fegetexcept@@GLIBC_2.2.5, remove
fegetexcept_2_2_5: .quad 0
.balign 8
.globl csinhf_2_2_5
.type csinhf_2_2_5, %function
.symver csinhf_2_2_5, csinhf@@GLIBC_2.2.5, remove
csinhf_2_2_5: .quad 0
.balign 8
.globl ctanhl_2_2_5
.type ctanhl_2_2_5, %function
.symver ctanhl_2_2_5, ctanhl@@GLIBC_2.2.5, remove
ctanhl_2_2_5: .quad 0
.balign 8
.globl cabs_2_2_5
.type cabs_2_2_5, %function
.symver cabs_2_2_5, cabs@@GLIBC_2.2.5, remove
cabs_2_2_5: .quad 0
.balign 8
.globl __log_finite_2_15
.type __log_finite_2_15, %function
.symver __log_finite_2_15, __log_finite@@GLIBC_2.15, remove
__log_finite_2_15: .quad 0
.balign 8
.globl modf_2_2_5
.type modf_2_2_5, %function
.symver modf_2_2_5, modf@@GLIBC_2.2.5, remove
modf_2_2_5: .quad 0
.balign 8
.globl __sqrtf_finite_2_15
.type __sqrtf_finite_2_15, %function
.symver __sqrtf_finite_2_15, __sqrtf_finite@@GLIBC_2.15, remove
__sqrtf_finite_2_15: .quad 0
.balign 8
.globl jnl_2_2_5
.type jnl_2_2_5, %function
.symver jnl_2_2_5, jnl@@GLIBC_2.2.5, remove
jnl_2_2_5: .quad 0
.balign 8
.globl __hypotl_finite_2_15
.type __hypotl_finite_2_15, %function
.symver __hypotl_finite_2_15, __hypotl_finite@@GLIBC_2.15, remove
__hypotl_finite_2_15: .quad 0
.balign 8
.globl fabsl_2_2_5
.type fabsl_2_2_5, %function
.symver fabsl_2_2_5, fabsl@@GLIBC_2.2.5, remove
fabsl_2_2_5: .quad 0
.balign 8
.globl __ynf_finite_2_15
.type __ynf_finite_2_15, %function
.symver __ynf_finite_2_15, __ynf_finite@@GLIBC_2.15, remove
__ynf_finite_2_15: .quad 0
.balign 8
.globl sincosf_2_2_5
.type sincosf_2_2_5, %function
.symver sincosf_2_2_5, sincosf@@GLIBC_2.2.5, remove
sincosf_2_2_5: .quad 0
.balign 8
.globl asinf_2_2_5
.type asinf_2_2_5, %function
.symver asinf_2_2_5, asinf@@GLIBC_2.2.5, remove
asinf_2_2_5: .quad 0
.balign 8
.globl lroundl_2_2_5
.type lroundl_2_2_5, %function
.symver lroundl_2_2_5, lroundl@@GLIBC_2.2.5, remove
lroundl_2_2_5: .quad 0
.balign 8
.globl clog10l_2_2_5
.type clog10l_2_2_5, %function
.symver clog10l_2_2_5, clog10l@@GLIBC_2.2.5, remove
clog10l_2_2_5: .quad 0
.balign 8
.globl __lgamma_r_finite_2_15
.type __lgamma_r_finite_2_15, %function
.symver __lgamma_r_finite_2_15, __lgamma_r_finite@@GLIBC_2.15, remove
__lgamma_r_finite_2_15: .quad 0
.balign 8
.globl asinh_2_2_5
.type asinh_2_2_5, %function
.symver asinh_2_2_5, asinh@@GLIBC_2.2.5, remove
asinh_2_2_5: .quad 0
.balign 8
.globl ynf_2_2_5
.type ynf_2_2_5, %function
.symver ynf_2_2_5, ynf@@GLIBC_2.2.5, remove
ynf_2_2_5: .quad 0
.balign 8
.globl exp2f_2_2_5
.type exp2f_2_2_5, %function
.symver exp2f_2_2_5, exp2f@@GLIBC_2.2.5, remove
exp2f_2_2_5: .quad 0
.balign 8
.globl fabsf_2_2_5
.type fabsf_2_2_5, %function
.symver fabsf_2_2_5, fabsf@@GLIBC_2.2.5, remove
fabsf_2_2_5: .quad 0
.balign 8
.globl atanhf_2_2_5
.type atanhf_2_2_5, %function
.symver atanhf_2_2_5, atanhf@@GLIBC_2.2.5, remove
atanhf_2_2_5: .quad 0
.balign 8
.globl lgamma_r_2_2_5
.type lgamma_r_2_2_5, %function
.symver lgamma_r_2_2_5, lgamma_r@@GLIBC_2.2.5, remove
lgamma_r_2_2_5: .quad 0
.balign 8
.globl nextafter_2_2_5
.type nextafter_2_2_5, %function
.symver nextafter_2_2_5, nextafter@@GLIBC_2.2.5, remove
nextafter_2_2_5: .quad 0
.balign 8
.globl clogl_2_2_5
.type clogl_2_2_5, %function
.symver clogl_2_2_5, clogl@@GLIBC_2.2.5, remove
clogl_2_2_5: .quad 0
.balign 8
.globl __finitel_2_2_5
.type __finitel_2_2_5, %function
.symver __finitel_2_2_5, __finitel@@GLIBC_2.2.5, remove
__finitel_2_2_5: .quad 0
.balign 8
.globl ccosf_2_2_5
.type ccosf_2_2_5, %function
.symver ccosf_2_2_5, ccosf@@GLIBC_2.2.5, remove
ccosf_2_2_5: .quad 0
.balign 8
.globl __powl_finite_2_15
.type __powl_finite_2_15, %function
.symver __powl_finite_2_15, __powl_finite@@GLIBC_2.15, remove
__powl_finite_2_15: .quad 0
.balign 8
.globl hypotf_2_2_5
.type hypotf_2_2_5, %function
.symver hypotf_2_2_5, hypotf@@GLIBC_2.2.5, remove
hypotf_2_2_5: .quad 0
.balign 8
.globl llroundf_2_2_5
.type llroundf_2_2_5, %function
.symver llroundf_2_2_5, llroundf@@GLIBC_2.2.5, remove
llroundf_2_2_5: .quad 0
.balign 8
.globl dreml_2_2_5
.type dreml_2_2_5, %function
.symver dreml_2_2_5, dreml@@GLIBC_2.2.5, remove
dreml_2_2_5: .quad 0
.balign 8
.globl j1l_2_2_5
.type j1l_2_2_5, %function
.symver j1l_2_2_5, j1l@@GLIBC_2.2.5, remove
j1l_2_2_5: .quad 0
.balign 8
.globl __scalbl_finite_2_15
.type __scalbl_finite_2_15, %function
.symver __scalbl_finite_2_15, __scalbl_finite@@GLIBC_2.15, remove
__scalbl_finite_2_15: .quad 0
.balign 8
.globl __hypot_finite_2_15
.type __hypot_finite_2_15, %function
.symver __hypot_finite_2_15, __hypot_finite@@GLIBC_2.15, remove
__hypot_finite_2_15: .quad 0
.balign 8
.globl ilogbf_2_2_5
.type ilogbf_2_2_5, %function
.symver ilogbf_2_2_5, ilogbf@@GLIBC_2.2.5, remove
ilogbf_2_2_5: .quad 0
.balign 8
.globl __y0_finite_2_15
.type __y0_finite_2_15, %function
.symver __y0_finite_2_15, __y0_finite@@GLIBC_2.15, remove
__y0_finite_2_15: .quad 0
.balign 8
.globl __atan2l_finite_2_15
.type __atan2l_finite_2_15, %function
.symver __atan2l_finite_2_15, __atan2l_finite@@GLIBC_2.15, remove
__atan2l_finite_2_15: .quad 0
.balign 8
.globl cacos_2_2_5
.type cacos_2_2_5, %function
.symver cacos_2_2_5, cacos@@GLIBC_2.2.5, remove
cacos_2_2_5: .quad 0
.balign 8
.globl conjl_2_2_5
.type conjl_2_2_5, %function
.symver conjl_2_2_5, conjl@@GLIBC_2.2.5, remove
conjl_2_2_5: .quad 0
.balign 8
.globl logbf_2_2_5
.type logbf_2_2_5, %function
.symver logbf_2_2_5, logbf@@GLIBC_2.2.5, remove
logbf_2_2_5: .quad 0
.balign 8
.globl logb_2_2_5
.type logb_2_2_5, %function
.symver logb_2_2_5, logb@@GLIBC_2.2.5, remove
logb_2_2_5: .quad 0
.balign 8
.globl __fpclassify_2_2_5
.type __fpclassify_2_2_5, %function
.symver __fpclassify_2_2_5, __fpclassify@@GLIBC_2.2.5, remove
__fpclassify_2_2_5: .quad 0
.balign 8
.globl __log10_finite_2_15
.type __log10_finite_2_15, %function
.symver __log10_finite_2_15, __log10_finite@@GLIBC_2.15, remove
__log10_finite_2_15: .quad 0
.balign 8
.globl __y0l_finite_2_15
.type __y0l_finite_2_15, %function
.symver __y0l_finite_2_15, __y0l_finite@@GLIBC_2.15, remove
__y0l_finite_2_15: .quad 0
.balign 8
.globl __atan2_finite_2_15
.type __atan2_finite_2_15, %function
.symver __atan2_finite_2_15, __atan2_finite@@GLIBC_2.15, remove
__atan2_finite_2_15: .quad 0
.balign 8
.globl cproj_2_2_5
.type cproj_2_2_5, %function
.symver cproj_2_2_5, cproj@@GLIBC_2.2.5, remove
cproj_2_2_5: .quad 0
.balign 8
.globl copysign_2_2_5
.type copysign_2_2_5, %function
.symver copysign_2_2_5, copysign@@GLIBC_2.2.5, remove
copysign_2_2_5: .quad 0
.balign 8
.globl fmin_2_2_5
.type fmin_2_2_5, %function
.symver fmin_2_2_5, fmin@@GLIBC_2.2.5, remove
fmin_2_2_5: .quad 0
.balign 8
.globl __exp10_finite_2_15
.type __exp10_finite_2_15, %function
.symver __exp10_finite_2_15, __exp10_finite@@GLIBC_2.15, remove
__exp10_finite_2_15: .quad 0
.balign 8
.globl lgamma_2_2_5
.type lgamma_2_2_5, %function
.symver lgamma_2_2_5, lgamma@@GLIBC_2.2.5, remove
lgamma_2_2_5: .quad 0
.balign 8
.globl remquo_2_2_5
.type remquo_2_2_5, %function
.symver remquo_2_2_5, remquo@@GLIBC_2.2.5, remove
remquo_2_2_5: .quad 0
.balign 8
.globl sin_2_2_5
.type sin_2_2_5, %function
.symver sin_2_2_5, sin@@GLIBC_2.2.5, remove
sin_2_2_5: .quad 0
.balign 8
.globl cexpf_2_2_5
.type cexpf_2_2_5, %function
.symver cexpf_2_2_5, cexpf@@GLIBC_2.2.5, remove
cexpf_2_2_5: .quad 0
.balign 8
.globl __log2l_finite_2_15
.type __log2l_finite_2_15, %function
.symver __log2l_finite_2_15, __log2l_finite@@GLIBC_2.15, remove
__log2l_finite_2_15: .quad 0
.balign 8
.globl fetestexcept_2_2_5
.type fetestexcept_2_2_5, %function
.symver fetestexcept_2_2_5, fetestexcept@@GLIBC_2.2.5, remove
fetestexcept_2_2_5: .quad 0
.balign 8
.globl nearbyintl_2_2_5
.type nearbyintl_2_2_5, %function
.symver nearbyintl_2_2_5, nearbyintl@@GLIBC_2.2.5, remove
nearbyintl_2_2_5: .quad 0
.balign 8
.globl scalbnl_2_2_5
.type scalbnl_2_2_5, %function
.symver scalbnl_2_2_5, scalbnl@@GLIBC_2.2.5, remove
scalbnl_2_2_5: .quad 0
.balign 8
.globl clog10_2_2_5
.type clog10_2_2_5, %function
.symver clog10_2_2_5, clog10@@GLIBC_2.2.5, remove
clog10_2_2_5: .quad 0
.balign 8
.globl rintl_2_2_5
.type rintl_2_2_5, %function
.symver rintl_2_2_5, rintl@@GLIBC_2.2.5, remove
rintl_2_2_5: .quad 0
.balign 8
.globl ctanh_2_2_5
.type ctanh_2_2_5, %function
.symver ctanh_2_2_5, ctanh@@GLIBC_2.2.5, remove
ctanh_2_2_5: .quad 0
.balign 8
.globl cacosl_2_2_5
.type cacosl_2_2_5, %function
.symver cacosl_2_2_5, cacosl@@GLIBC_2.2.5, remove
cacosl_2_2_5: .quad 0
.balign 8
.globl __signbit_2_2_5
.type __signbit_2_2_5, %function
.symver __signbit_2_2_5, __signbit@@GLIBC_2.2.5, remove
__signbit_2_2_5: .quad 0
.balign 8
.globl ctanf_2_2_5
.type ctanf_2_2_5, %function
.symver ctanf_2_2_5, ctanf@@GLIBC_2.2.5, remove
ctanf_2_2_5: .quad 0
.balign 8
.globl cpowf_2_2_5
.type cpowf_2_2_5, %function
.symver cpowf_2_2_5, cpowf@@GLIBC_2.2.5, remove
cpowf_2_2_5: .quad 0
.balign 8
.globl ccos_2_2_5
.type ccos_2_2_5, %function
.symver ccos_2_2_5, ccos@@GLIBC_2.2.5, remove
ccos_2_2_5: .quad 0
.balign 8
.globl __cosh_finite_2_15
.type __cosh_finite_2_15, %function
.symver __cosh_finite_2_15, __cosh_finite@@GLIBC_2.15, remove
__cosh_finite_2_15: .quad 0
.balign 8
.globl log2l_2_2_5
.type log2l_2_2_5, %function
.symver log2l_2_2_5, log2l@@GLIBC_2.2.5, remove
log2l_2_2_5: .quad 0
.balign 8
.globl floor_2_2_5
.type floor_2_2_5, %function
.symver floor_2_2_5, floor@@GLIBC_2.2.5, remove
floor_2_2_5: .quad 0
.balign 8
.globl __gamma_r_finite_2_15
.type __gamma_r_finite_2_15, %function
.symver __gamma_r_finite_2_15, __gamma_r_finite@@GLIBC_2.15, remove
__gamma_r_finite_2_15: .quad 0
.balign 8
.globl csqrtl_2_2_5
.type csqrtl_2_2_5, %function
.symver csqrtl_2_2_5, csqrtl@@GLIBC_2.2.5, remove
csqrtl_2_2_5: .quad 0
.balign 8
.globl remainderf_2_2_5
.type remainderf_2_2_5, %function
.symver remainderf_2_2_5, remainderf@@GLIBC_2.2.5, remove
remainderf_2_2_5: .quad 0
.balign 8
.globl cexp_2_2_5
.type cexp_2_2_5, %function
.symver cexp_2_2_5, cexp@@GLIBC_2.2.5, remove
cexp_2_2_5: .quad 0
.balign 8
.globl expm1f_2_2_5
.type expm1f_2_2_5, %function
.symver expm1f_2_2_5, expm1f@@GLIBC_2.2.5, remove
expm1f_2_2_5: .quad 0
.balign 8
.globl __coshf_finite_2_15
.type __coshf_finite_2_15, %function
.symver __coshf_finite_2_15, __coshf_finite@@GLIBC_2.15, remove
__coshf_finite_2_15: .quad 0
.balign 8
.globl scalbln_2_2_5
.type scalbln_2_2_5, %function
.symver scalbln_2_2_5, scalbln@@GLIBC_2.2.5, remove
scalbln_2_2_5: .quad 0
.balign 8
.globl __exp2l_finite_2_15
.type __exp2l_finite_2_15, %function
.symver __exp2l_finite_2_15, __exp2l_finite@@GLIBC_2.15, remove
__exp2l_finite_2_15: .quad 0
.balign 8
.globl ilogb_2_2_5
.type ilogb_2_2_5, %function
.symver ilogb_2_2_5, ilogb@@GLIBC_2.2.5, remove
ilogb_2_2_5: .quad 0
.balign 8
.globl creal_2_2_5
.type creal_2_2_5, %function
.symver creal_2_2_5, creal@@GLIBC_2.2.5, remove
creal_2_2_5: .quad 0
.balign 8
.globl lgammaf_2_2_5
.type lgammaf_2_2_5, %function
.symver lgammaf_2_2_5, lgammaf@@GLIBC_2.2.5, remove
lgammaf_2_2_5: .quad 0
.balign 8
.globl sqrtf_2_2_5
.type sqrtf_2_2_5, %function
.symver sqrtf_2_2_5, sqrtf@@GLIBC_2.2.5, remove
sqrtf_2_2_5: .quad 0
.balign 8
.globl fmaf_2_2_5
.type fmaf_2_2_5, %function
.symver fmaf_2_2_5, fmaf@@GLIBC_2.2.5, remove
fmaf_2_2_5: .quad 0
.balign 8
.globl nextafterl_2_2_5
.type nextafterl_2_2_5, %function
.symver nextafterl_2_2_5, nextafterl@@GLIBC_2.2.5, remove
nextafterl_2_2_5: .quad 0
.balign 8
.globl fabs_2_2_5
.type fabs_2_2_5, %function
.symver fabs_2_2_5, fabs@@GLIBC_2.2.5, remove
fabs_2_2_5: .quad 0
.balign 8
.globl modff_2_2_5
.type modff_2_2_5, %function
.symver modff_2_2_5, modff@@GLIBC_2.2.5, remove
modff_2_2_5: .quad 0
.balign 8
.globl nearbyintf_2_2_5
.type nearbyintf_2_2_5, %function
.symver nearbyintf_2_2_5, nearbyintf@@GLIBC_2.2.5, remove
nearbyintf_2_2_5: .quad 0
.balign 8
.globl __atanh_finite_2_15
.type __atanh_finite_2_15, %function
.symver __atanh_finite_2_15, __atanh_finite@@GLIBC_2.15, remove
__atanh_finite_2_15: .quad 0
.balign 8
.globl exp2_2_2_5
.type exp2_2_2_5, %function
.symver exp2_2_2_5, exp2@@GLIBC_2.2.5, remove
exp2_2_2_5: .quad 0
.balign 8
.globl copysignl_2_2_5
.type copysignl_2_2_5, %function
.symver copysignl_2_2_5, copysignl@@GLIBC_2.2.5, remove
copysignl_2_2_5: .quad 0
.balign 8
.globl asin_2_2_5
.type asin_2_2_5, %function
.symver asin_2_2_5, asin@@GLIBC_2.2.5, remove
asin_2_2_5: .quad 0
.balign 8
.globl __finite_2_2_5
.type __finite_2_2_5, %function
.symver __finite_2_2_5, __finite@@GLIBC_2.2.5, remove
__finite_2_2_5: .quad 0
.balign 8
.globl cprojf_2_2_5
.type cprojf_2_2_5, %function
.symver cprojf_2_2_5, cprojf@@GLIBC_2.2.5, remove
cprojf_2_2_5: .quad 0
.balign 8
.globl __fmod_finite_2_15
.type __fmod_finite_2_15, %function
.symver __fmod_finite_2_15, __fmod_finite@@GLIBC_2.15, remove
__fmod_finite_2_15: .quad 0
.balign 8
.globl sinf_2_2_5
.type sinf_2_2_5, %function
.symver sinf_2_2_5, sinf@@GLIBC_2.2.5, remove
sinf_2_2_5: .quad 0
.balign 8
.globl atanhl_2_2_5
.type atanhl_2_2_5, %function
.symver atanhl_2_2_5, atanhl@@GLIBC_2.2.5, remove
atanhl_2_2_5: .quad 0
.balign 8
.globl clog_2_2_5
.type clog_2_2_5, %function
.symver clog_2_2_5, clog@@GLIBC_2.2.5, remove
clog_2_2_5: .quad 0
.balign 8
.globl __fpclassifyl_2_2_5
.type __fpclassifyl_2_2_5, %function
.symver __fpclassifyl_2_2_5, __fpclassifyl@@GLIBC_2.2.5, remove
__fpclassifyl_2_2_5: .quad 0
.balign 8
.globl tanl_2_2_5
.type tanl_2_2_5, %function
.symver tanl_2_2_5, tanl@@GLIBC_2.2.5, remove
tanl_2_2_5: .quad 0
.balign 8
.globl log1pf_2_2_5
.type log1pf_2_2_5, %function
.symver log1pf_2_2_5, log1pf@@GLIBC_2.2.5, remove
log1pf_2_2_5: .quad 0
.balign 8
.globl y1l_2_2_5
.type y1l_2_2_5, %function
.symver y1l_2_2_5, y1l@@GLIBC_2.2.5, remove
y1l_2_2_5: .quad 0
.balign 8
.globl cacoshl_2_2_5
.type cacoshl_2_2_5, %function
.symver cacoshl_2_2_5, cacoshl@@GLIBC_2.2.5, remove
cacoshl_2_2_5: .quad 0
.balign 8
.globl remainder_2_2_5
.type remainder_2_2_5, %function
.symver remainder_2_2_5, remainder@@GLIBC_2.2.5, remove
remainder_2_2_5: .quad 0
.balign 8
.globl llrint_2_2_5
.type llrint_2_2_5, %function
.symver llrint_2_2_5, llrint@@GLIBC_2.2.5, remove
llrint_2_2_5: .quad 0
.balign 8
.globl nanl_2_2_5
.type nanl_2_2_5, %function
.symver nanl_2_2_5, nanl@@GLIBC_2.2.5, remove
nanl_2_2_5: .quad 0
.balign 8
.globl __y1l_finite_2_15
.type __y1l_finite_2_15, %function
.symver __y1l_finite_2_15, __y1l_finite@@GLIBC_2.15, remove
__y1l_finite_2_15: .quad 0
.balign 8
.globl nexttowardl_2_2_5
.type nexttowardl_2_2_5, %function
.symver nexttowardl_2_2_5, nexttowardl@@GLIBC_2.2.5, remove
nexttowardl_2_2_5: .quad 0
.balign 8
.globl csinhl_2_2_5
.type csinhl_2_2_5, %function
.symver csinhl_2_2_5, csinhl@@GLIBC_2.2.5, remove
csinhl_2_2_5: .quad 0
.balign 8
.globl gammal_2_2_5
.type gammal_2_2_5, %function
.symver gammal_2_2_5, gammal@@GLIBC_2.2.5, remove
gammal_2_2_5: .quad 0
.balign 8
.globl __j1f_finite_2_15
.type __j1f_finite_2_15, %function
.symver __j1f_finite_2_15, __j1f_finite@@GLIBC_2.15, remove
__j1f_finite_2_15: .quad 0
.balign 8
.globl csinh_2_2_5
.type csinh_2_2_5, %function
.symver csinh_2_2_5, csinh@@GLIBC_2.2.5, remove
csinh_2_2_5: .quad 0
.balign 8
.globl sqrt_2_2_5
.type sqrt_2_2_5, %function
.symver sqrt_2_2_5, sqrt@@GLIBC_2.2.5, remove
sqrt_2_2_5: .quad 0
.balign 8
.globl cacosh_2_2_5
.type cacosh_2_2_5, %function
.symver cacosh_2_2_5, cacosh@@GLIBC_2.2.5, remove
cacosh_2_2_5: .quad 0
.balign 8
.globl __clog10_2_2_5
.type __clog10_2_2_5, %function
.symver __clog10_2_2_5, __clog10@@GLIBC_2.2.5, remove
__clog10_2_2_5: .quad 0
.balign 8
.globl acos_2_2_5
.type acos_2_2_5, %function
.symver acos_2_2_5, acos@@GLIBC_2.2.5, remove
acos_2_2_5: .quad 0
.balign 8
.globl remquol_2_2_5
.type remquol_2_2_5, %function
.symver remquol_2_2_5, remquol@@GLIBC_2.2.5, remove
remquol_2_2_5: .quad 0
.balign 8
.globl __asinl_finite_2_15
.type __asinl_finite_2_15, %function
.symver __asinl_finite_2_15, __asinl_finite@@GLIBC_2.15, remove
__asinl_finite_2_15: .quad 0
.balign 8
.globl __gammal_r_finite_2_15
.type __gammal_r_finite_2_15, %function
.symver __gammal_r_finite_2_15, __gammal_r_finite@@GLIBC_2.15, remove
__gammal_r_finite_2_15: .quad 0
.balign 8
.globl clog10f_2_2_5
.type clog10f_2_2_5, %function
.symver clog10f_2_2_5, clog10f@@GLIBC_2.2.5, remove
clog10f_2_2_5: .quad 0
.balign 8
.globl scalb_2_2_5
.type scalb_2_2_5, %function
.symver scalb_2_2_5, scalb@@GLIBC_2.2.5, remove
scalb_2_2_5: .quad 0
.balign 8
.globl __jnf_finite_2_15
.type __jnf_finite_2_15, %function
.symver __jnf_finite_2_15, __jnf_finite@@GLIBC_2.15, remove
__jnf_finite_2_15: .quad 0
.balign 8
.globl feupdateenv_2_2_5
.type feupdateenv_2_2_5, %function
.symver feupdateenv_2_2_5, feupdateenv@@GLIBC_2.2.5, remove
feupdateenv_2_2_5: .quad 0
.balign 8
.globl __clog10f_2_2_5
.type __clog10f_2_2_5, %function
.symver __clog10f_2_2_5, __clog10f@@GLIBC_2.2.5, remove
__clog10f_2_2_5: .quad 0
.balign 8
.globl cosl_2_2_5
.type cosl_2_2_5, %function
.symver cosl_2_2_5, cosl@@GLIBC_2.2.5, remove
cosl_2_2_5: .quad 0
.balign 8
.globl __sinhl_finite_2_15
.type __sinhl_finite_2_15, %function
.symver __sinhl_finite_2_15, __sinhl_finite@@GLIBC_2.15, remove
__sinhl_finite_2_15: .quad 0
.balign 8
.globl fmod_2_2_5
.type fmod_2_2_5, %function
.symver fmod_2_2_5, fmod@@GLIBC_2.2.5, remove
fmod_2_2_5: .quad 0
.balign 8
.globl y0_2_2_5
.type y0_2_2_5, %function
.symver y0_2_2_5, y0@@GLIBC_2.2.5, remove
y0_2_2_5: .quad 0
.balign 8
.globl __j0_finite_2_15
.type __j0_finite_2_15, %function
.symver __j0_finite_2_15, __j0_finite@@GLIBC_2.15, remove
__j0_finite_2_15: .quad 0
.balign 8
.globl lgammal_2_2_5
.type lgammal_2_2_5, %function
.symver lgammal_2_2_5, lgammal@@GLIBC_2.2.5, remove
lgammal_2_2_5: .quad 0
.balign 8
.globl __log10l_finite_2_15
.type __log10l_finite_2_15, %function
.symver __log10l_finite_2_15, __log10l_finite@@GLIBC_2.15, remove
__log10l_finite_2_15: .quad 0
.balign 8
.globl finite_2_2_5
.type finite_2_2_5, %function
.symver finite_2_2_5, finite@@GLIBC_2.2.5, remove
finite_2_2_5: .quad 0
.balign 8
.globl dremf_2_2_5
.type dremf_2_2_5, %function
.symver dremf_2_2_5, dremf@@GLIBC_2.2.5, remove
dremf_2_2_5: .quad 0
.balign 8
.globl __log10f_finite_2_15
.type __log10f_finite_2_15, %function
.symver __log10f_finite_2_15, __log10f_finite@@GLIBC_2.15, remove
__log10f_finite_2_15: .quad 0
.balign 8
.globl erfcf_2_2_5
.type erfcf_2_2_5, %function
.symver erfcf_2_2_5, erfcf@@GLIBC_2.2.5, remove
erfcf_2_2_5: .quad 0
.balign 8
.globl roundf_2_2_5
.type roundf_2_2_5, %function
.symver roundf_2_2_5, roundf@@GLIBC_2.2.5, remove
roundf_2_2_5: .quad 0
.balign 8
.globl __finitef_2_2_5
.type __finitef_2_2_5, %function
.symver __finitef_2_2_5, __finitef@@GLIBC_2.2.5, remove
__finitef_2_2_5: .quad 0
.balign 8
.globl __acoshf_finite_2_15
.type __acoshf_finite_2_15, %function
.symver __acoshf_finite_2_15, __acoshf_finite@@GLIBC_2.15, remove
__acoshf_finite_2_15: .quad 0
.balign 8
.globl __exp2f_finite_2_15
.type __exp2f_finite_2_15, %function
.symver __exp2f_finite_2_15, __exp2f_finite@@GLIBC_2.15, remove
__exp2f_finite_2_15: .quad 0
.balign 8
.globl ctan_2_2_5
.type ctan_2_2_5, %function
.symver ctan_2_2_5, ctan@@GLIBC_2.2.5, remove
ctan_2_2_5: .quad 0
.balign 8
.globl cargl_2_2_5
.type cargl_2_2_5, %function
.symver cargl_2_2_5, cargl@@GLIBC_2.2.5, remove
cargl_2_2_5: .quad 0
.balign 8
.globl ilogbl_2_2_5
.type ilogbl_2_2_5, %function
.symver ilogbl_2_2_5, ilogbl@@GLIBC_2.2.5, remove
ilogbl_2_2_5: .quad 0
.balign 8
.globl cbrtl_2_2_5
.type cbrtl_2_2_5, %function
.symver cbrtl_2_2_5, cbrtl@@GLIBC_2.2.5, remove
cbrtl_2_2_5: .quad 0
.balign 8
.globl finitef_2_2_5
.type finitef_2_2_5, %function
.symver finitef_2_2_5, finitef@@GLIBC_2.2.5, remove
finitef_2_2_5: .quad 0
.balign 8
.globl exp2l_2_2_5
.type exp2l_2_2_5, %function
.symver exp2l_2_2_5, exp2l@@GLIBC_2.2.5, remove
exp2l_2_2_5: .quad 0
.balign 8
.globl __logf_finite_2_15
.type __logf_finite_2_15, %function
.symver __logf_finite_2_15, __logf_finite@@GLIBC_2.15, remove
__logf_finite_2_15: .quad 0
.balign 8
.globl __scalbf_finite_2_15
.type __scalbf_finite_2_15, %function
.symver __scalbf_finite_2_15, __scalbf_finite@@GLIBC_2.15, remove
__scalbf_finite_2_15: .quad 0
.balign 8
.globl atan2f_2_2_5
.type atan2f_2_2_5, %function
.symver atan2f_2_2_5, atan2f@@GLIBC_2.2.5, remove
atan2f_2_2_5: .quad 0
.balign 8
.globl __j0f_finite_2_15
.type __j0f_finite_2_15, %function
.symver __j0f_finite_2_15, __j0f_finite@@GLIBC_2.15, remove
__j0f_finite_2_15: .quad 0
.balign 8
.globl truncl_2_2_5
.type truncl_2_2_5, %function
.symver truncl_2_2_5, truncl@@GLIBC_2.2.5, remove
truncl_2_2_5: .quad 0
.balign 8
.globl carg_2_2_5
.type carg_2_2_5, %function
.symver carg_2_2_5, carg@@GLIBC_2.2.5, remove
carg_2_2_5: .quad 0
.balign 8
.globl log_2_2_5
.type log_2_2_5, %function
.symver log_2_2_5, log@@GLIBC_2.2.5, remove
log_2_2_5: .quad 0
.balign 8
.globl frexpf_2_2_5
.type frexpf_2_2_5, %function
.symver frexpf_2_2_5, frexpf@@GLIBC_2.2.5, remove
frexpf_2_2_5: .quad 0
.balign 8
.globl fminl_2_2_5
.type fminl_2_2_5, %function
.symver fminl_2_2_5, fminl@@GLIBC_2.2.5, remove
fminl_2_2_5: .quad 0
.balign 8
.globl __fmodl_finite_2_15
.type __fmodl_finite_2_15, %function
.symver __fmodl_finite_2_15, __fmodl_finite@@GLIBC_2.15, remove
__fmodl_finite_2_15: .quad 0
.balign 8
.globl __expl_finite_2_15
.type __expl_finite_2_15, %function
.symver __expl_finite_2_15, __expl_finite@@GLIBC_2.15, remove
__expl_finite_2_15: .quad 0
.balign 8
.globl fmodl_2_2_5
.type fmodl_2_2_5, %function
.symver fmodl_2_2_5, fmodl@@GLIBC_2.2.5, remove
fmodl_2_2_5: .quad 0
.balign 8
.globl atanf_2_2_5
.type atanf_2_2_5, %function
.symver atanf_2_2_5, atanf@@GLIBC_2.2.5, remove
atanf_2_2_5: .quad 0
.balign 8
.globl pow10l_2_2_5
.type pow10l_2_2_5, %function
.symver pow10l_2_2_5, pow10l@@GLIBC_2.2.5, remove
pow10l_2_2_5: .quad 0
.balign 8
.globl sincosl_2_2_5
.type sincosl_2_2_5, %function
.symver sincosl_2_2_5, sincosl@@GLIBC_2.2.5, remove
sincosl_2_2_5: .quad 0
.balign 8
.globl scalbl_2_2_5
.type scalbl_2_2_5, %function
.symver scalbl_2_2_5, scalbl@@GLIBC_2.2.5, remove
scalbl_2_2_5: .quad 0
.balign 8
.globl __remainderf_finite_2_15
.type __remainderf_finite_2_15, %function
.symver __remainderf_finite_2_15, __remainderf_finite@@GLIBC_2.15, remove
__remainderf_finite_2_15: .quad 0
.balign 8
.globl ctanl_2_2_5
.type ctanl_2_2_5, %function
.symver ctanl_2_2_5, ctanl@@GLIBC_2.2.5, remove
ctanl_2_2_5: .quad 0
.balign 8
.globl atan2l_2_2_5
.type atan2l_2_2_5, %function
.symver atan2l_2_2_5, atan2l@@GLIBC_2.2.5, remove
atan2l_2_2_5: .quad 0
.balign 8
.globl __exp2_finite_2_15
.type __exp2_finite_2_15, %function
.symver __exp2_finite_2_15, __exp2_finite@@GLIBC_2.15, remove
__exp2_finite_2_15: .quad 0
.balign 8
.globl log1pl_2_2_5
.type log1pl_2_2_5, %function
.symver log1pl_2_2_5, log1pl@@GLIBC_2.2.5, remove
log1pl_2_2_5: .quad 0
.balign 8
.globl __sqrt_finite_2_15
.type __sqrt_finite_2_15, %function
.symver __sqrt_finite_2_15, __sqrt_finite@@GLIBC_2.15, remove
__sqrt_finite_2_15: .quad 0
.balign 8
.globl significandl_2_2_5
.type significandl_2_2_5, %function
.symver significandl_2_2_5, significandl@@GLIBC_2.2.5, remove
significandl_2_2_5: .quad 0
.balign 8
.globl casinhf_2_2_5
.type casinhf_2_2_5, %function
.symver casinhf_2_2_5, casinhf@@GLIBC_2.2.5, remove
casinhf_2_2_5: .quad 0
.balign 8
.globl llroundl_2_2_5
.type llroundl_2_2_5, %function
.symver llroundl_2_2_5, llroundl@@GLIBC_2.2.5, remove
llroundl_2_2_5: .quad 0
.balign 8
.globl __remainder_finite_2_15
.type __remainder_finite_2_15, %function
.symver __remainder_finite_2_15, __remainder_finite@@GLIBC_2.15, remove
__remainder_finite_2_15: .quad 0
.balign 8
.globl pow10_2_2_5
.type pow10_2_2_5, %function
.symver pow10_2_2_5, pow10@@GLIBC_2.2.5, remove
pow10_2_2_5: .quad 0
.balign 8
.globl llrintf_2_2_5
.type llrintf_2_2_5, %function
.symver llrintf_2_2_5, llrintf@@GLIBC_2.2.5, remove
llrintf_2_2_5: .quad 0
.rodata
.data
.balign 8
.globl _LIB_VERSION_2_2_5
.type _LIB_VERSION_2_2_5, %object
.size _LIB_VERSION_2_2_5, 4
.symver _LIB_VERSION_2_2_5, _LIB_VERSION@@GLIBC_2.2.5, remove
_LIB_VERSION_2_2_5: .fill 4, 1, 0
.balign 8
.globl signgam_2_2_5
.type signgam_2_2_5, %object
.size signgam_2_2_5, 4
.symver signgam_2_2_5, signgam@@GLIBC_2.2.5, remove
signgam_2_2_5: .fill 4, 1, 0
