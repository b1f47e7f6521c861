.text
.balign 8
.globl __res_nsend_2_2_5
.type __res_nsend_2_2_5, %function
.symver __res_nsend_2_2_5, __res_nsend@@GLIBC_2.2.5, remove
__res_nsend_2_2_5: .quad 0
.balign 8
.globl ns_name_rollback_2_9
.type ns_name_rollback_2_9, %function
.symver ns_name_rollback_2_9, ns_name_rollback@@GLIBC_2.9, remove
ns_name_rollback_2_9: .quad 0
.balign 8
.globl ns_sprintrrf_2_9
.type ns_sprintrrf_2_9, %function
.symver ns_sprintrrf_2_9, ns_sprintrrf@@GLIBC_2.9, remove
ns_sprintrrf_2_9: .quad 0
.balign 8
.globl ns_format_ttl_2_9
.type ns_format_ttl_2_9, %function
.symver ns_format_ttl_2_9, ns_format_ttl@@GLIBC_2.9, remove
ns_format_ttl_2_9: .quad 0
.balign 8
.globl __p_class_2_2_5
.type __p_class_2_2_5, %function
.symver __p_class_2_2_5, __p_class@@GLIBC_2.2.5, remove
__p_class_2_2_5: .quad 0
.balign 8
.globl __res_hnok_2_2_5
.type __res_hnok_2_2_5, %function
.symver __res_hnok_2_2_5, __res_hnok@@GLIBC_2.2.5, remove
__res_hnok_2_2_5: .quad 0
.balign 8
.globl __dn_expand_2_2_5
.type __dn_expand_2_2_5, %function
.symver __dn_expand_2_2_5, __dn_expand@@GLIBC_2.2.5, remove
__dn_expand_2_2_5: .quad 0
.balign 8
.globl __putlong_2_2_5
.type __putlong_2_2_5, %function
.symver __putlong_2_2_5, __putlong@@GLIBC_2.2.5, remove
__putlong_2_2_5: .quad 0
.balign 8
.globl __p_fqnname_2_2_5
.type __p_fqnname_2_2_5, %function
.symver __p_fqnname_2_2_5, __p_fqnname@@GLIBC_2.2.5, remove
__p_fqnname_2_2_5: .quad 0
.balign 8
.globl _gethtbyname_2_2_5
.type _gethtbyname_2_2_5, %function
.symver _gethtbyname_2_2_5, _gethtbyname@@GLIBC_2.2.5, remove
_gethtbyname_2_2_5: .quad 0
.balign 8
.globl inet_neta_2_2_5
.type inet_neta_2_2_5, %function
.symver inet_neta_2_2_5, inet_neta@@GLIBC_2.2.5, remove
inet_neta_2_2_5: .quad 0
.balign 8
.globl __p_rcode_2_3_2
.type __p_rcode_2_3_2, %function
.symver __p_rcode_2_3_2, __p_rcode@@GLIBC_2.3.2, remove
__p_rcode_2_3_2: .quad 0
.balign 8
.globl ns_name_ntol_2_9
.type ns_name_ntol_2_9, %function
.symver ns_name_ntol_2_9, ns_name_ntol@@GLIBC_2.9, remove
ns_name_ntol_2_9: .quad 0
.balign 8
.globl ns_name_compress_2_9
.type ns_name_compress_2_9, %function
.symver ns_name_compress_2_9, ns_name_compress@@GLIBC_2.9, remove
ns_name_compress_2_9: .quad 0
.balign 8
.globl ns_name_ntop_2_9
.type ns_name_ntop_2_9, %function
.symver ns_name_ntop_2_9, ns_name_ntop@@GLIBC_2.9, remove
ns_name_ntop_2_9: .quad 0
.balign 8
.globl __dn_count_labels_2_2_5
.type __dn_count_labels_2_2_5, %function
.symver __dn_count_labels_2_2_5, __dn_count_labels@@GLIBC_2.2.5, remove
__dn_count_labels_2_2_5: .quad 0
.balign 8
.globl __sym_ntos_2_2_5
.type __sym_ntos_2_2_5, %function
.symver __sym_ntos_2_2_5, __sym_ntos@@GLIBC_2.2.5, remove
__sym_ntos_2_2_5: .quad 0
.balign 8
.globl __p_secstodate_2_2_5
.type __p_secstodate_2_2_5, %function
.symver __p_secstodate_2_2_5, __p_secstodate@@GLIBC_2.2.5, remove
__p_secstodate_2_2_5: .quad 0
.balign 8
.globl ns_name_unpack_2_9
.type ns_name_unpack_2_9, %function
.symver ns_name_unpack_2_9, ns_name_unpack@@GLIBC_2.9, remove
ns_name_unpack_2_9: .quad 0
.balign 8
.globl ns_samedomain_2_9
.type ns_samedomain_2_9, %function
.symver ns_samedomain_2_9, ns_samedomain@@GLIBC_2.9, remove
ns_samedomain_2_9: .quad 0
.balign 8
.globl __p_query_2_2_5
.type __p_query_2_2_5, %function
.symver __p_query_2_2_5, __p_query@@GLIBC_2.2.5, remove
__p_query_2_2_5: .quad 0
.balign 8
.globl __p_cdname_2_2_5
.type __p_cdname_2_2_5, %function
.symver __p_cdname_2_2_5, __p_cdname@@GLIBC_2.2.5, remove
__p_cdname_2_2_5: .quad 0
.balign 8
.globl __res_nsearch_2_2_5
.type __res_nsearch_2_2_5, %function
.symver __res_nsearch_2_2_5, __res_nsearch@@GLIBC_2.2.5, remove
__res_nsearch_2_2_5: .quad 0
.balign 8
.globl ns_name_skip_2_9
.type ns_name_skip_2_9, %function
.symver ns_name_skip_2_9, ns_name_skip@@GLIBC_2.9, remove
ns_name_skip_2_9: .quad 0
.balign 8
.globl ns_initparse_2_9
.type ns_initparse_2_9, %function
.symver ns_initparse_2_9, ns_initparse@@GLIBC_2.9, remove
ns_initparse_2_9: .quad 0
.balign 8
.globl __res_nquerydomain_2_2_5
.type __res_nquerydomain_2_2_5, %function
.symver __res_nquerydomain_2_2_5, __res_nquerydomain@@GLIBC_2.2.5, remove
__res_nquerydomain_2_2_5: .quad 0
.balign 8
.globl __p_type_2_2_5
.type __p_type_2_2_5, %function
.symver __p_type_2_2_5, __p_type@@GLIBC_2.2.5, remove
__p_type_2_2_5: .quad 0
.balign 8
.globl __res_query_2_2_5
.type __res_query_2_2_5, %function
.symver __res_query_2_2_5, __res_query@@GLIBC_2.2.5, remove
__res_query_2_2_5: .quad 0
.balign 8
.globl ns_name_uncompress_2_9
.type ns_name_uncompress_2_9, %function
.symver ns_name_uncompress_2_9, ns_name_uncompress@@GLIBC_2.9, remove
ns_name_uncompress_2_9: .quad 0
.balign 8
.globl ns_put32_2_9
.type ns_put32_2_9, %function
.symver ns_put32_2_9, ns_put32@@GLIBC_2.9, remove
ns_put32_2_9: .quad 0
.balign 8
.globl inet_net_pton_2_2_5
.type inet_net_pton_2_2_5, %function
.symver inet_net_pton_2_2_5, inet_net_pton@@GLIBC_2.2.5, remove
inet_net_pton_2_2_5: .quad 0
.balign 8
.globl ns_msg_getflag_2_9
.type ns_msg_getflag_2_9, %function
.symver ns_msg_getflag_2_9, ns_msg_getflag@@GLIBC_2.9, remove
ns_msg_getflag_2_9: .quad 0
.balign 8
.globl __res_nmkquery_2_2_5
.type __res_nmkquery_2_2_5, %function
.symver __res_nmkquery_2_2_5, __res_nmkquery@@GLIBC_2.2.5, remove
__res_nmkquery_2_2_5: .quad 0
.balign 8
.globl res_gethostbyname2_2_2_5
.type res_gethostbyname2_2_2_5, %function
.symver res_gethostbyname2_2_2_5, res_gethostbyname2@@GLIBC_2.2.5, remove
res_gethostbyname2_2_2_5: .quad 0
.balign 8
.globl __dn_comp_2_2_5
.type __dn_comp_2_2_5, %function
.symver __dn_comp_2_2_5, __dn_comp@@GLIBC_2.2.5, remove
__dn_comp_2_2_5: .quad 0
.balign 8
.globl __res_send_2_2_5
.type __res_send_2_2_5, %function
.symver __res_send_2_2_5, __res_send@@GLIBC_2.2.5, remove
__res_send_2_2_5: .quad 0
.balign 8
.globl ns_name_pack_2_9
.type ns_name_pack_2_9, %function
.symver ns_name_pack_2_9, ns_name_pack@@GLIBC_2.9, remove
ns_name_pack_2_9: .quad 0
.balign 8
.globl ns_makecanon_2_9
.type ns_makecanon_2_9, %function
.symver ns_makecanon_2_9, ns_makecanon@@GLIBC_2.9, remove
ns_makecanon_2_9: .quad 0
.balign 8
.globl res_gethostbyaddr_2_2_5
.type res_gethostbyaddr_2_2_5, %function
.symver res_gethostbyaddr_2_2_5, res_gethostbyaddr@@GLIBC_2.2.5, remove
res_gethostbyaddr_2_2_5: .quad 0
.balign 8
.globl __res_ownok_2_2_5
.type __res_ownok_2_2_5, %function
.symver __res_ownok_2_2_5, __res_ownok@@GLIBC_2.2.5, remove
__res_ownok_2_2_5: .quad 0
.balign 8
.globl __sym_ntop_2_2_5
.type __sym_ntop_2_2_5, %function
.symver __sym_ntop_2_2_5, __sym_ntop@@GLIBC_2.2.5, remove
__sym_ntop_2_2_5: .quad 0
.balign 8
.globl __b64_pton_2_2_5
.type __b64_pton_2_2_5, %function
.symver __b64_pton_2_2_5, __b64_pton@@GLIBC_2.2.5, remove
__b64_pton_2_2_5: .quad 0
.balign 8
.globl __fp_query_2_2_5
.type __fp_query_2_2_5, %function
.symver __fp_query_2_2_5, __fp_query@@GLIBC_2.2.5, remove
__fp_query_2_2_5: .quad 0
.balign 8
.globl ns_name_pton_2_9
.type ns_name_pton_2_9, %function
.symver ns_name_pton_2_9, ns_name_pton@@GLIBC_2.9, remove
ns_name_pton_2_9: .quad 0
.balign 8
.globl __p_fqname_2_2_5
.type __p_fqname_2_2_5, %function
.symver __p_fqname_2_2_5, __p_fqname@@GLIBC_2.2.5, remove
__p_fqname_2_2_5: .quad 0
.balign 8
.globl ns_put16_2_9
.type ns_put16_2_9, %function
.symver ns_put16_2_9, ns_put16@@GLIBC_2.9, remove
ns_put16_2_9: .quad 0
.balign 8
.globl __res_hostalias_2_2_5
.type __res_hostalias_2_2_5, %function
.symver __res_hostalias_2_2_5, __res_hostalias@@GLIBC_2.2.5, remove
__res_hostalias_2_2_5: .quad 0
.balign 8
.globl __fp_nquery_2_2_5
.type __fp_nquery_2_2_5, %function
.symver __fp_nquery_2_2_5, __fp_nquery@@GLIBC_2.2.5, remove
__fp_nquery_2_2_5: .quad 0
.balign 8
.globl __loc_ntoa_2_2_5
.type __loc_ntoa_2_2_5, %function
.symver __loc_ntoa_2_2_5, __loc_ntoa@@GLIBC_2.2.5, remove
__loc_ntoa_2_2_5: .quad 0
.balign 8
.globl _sethtent_2_2_5
.type _sethtent_2_2_5, %function
.symver _sethtent_2_2_5, _sethtent@@GLIBC_2.2.5, remove
_sethtent_2_2_5: .quad 0
.balign 8
.globl __res_nquery_2_2_5
.type __res_nquery_2_2_5, %function
.symver __res_nquery_2_2_5, __res_nquery@@GLIBC_2.2.5, remove
__res_nquery_2_2_5: .quad 0
.balign 8
.globl __res_mailok_2_2_5
.type __res_mailok_2_2_5, %function
.symver __res_mailok_2_2_5, __res_mailok@@GLIBC_2.2.5, remove
__res_mailok_2_2_5: .quad 0
.balign 8
.globl res_send_setqhook_2_2_5
.type res_send_setqhook_2_2_5, %function
.symver res_send_setqhook_2_2_5, res_send_setqhook@@GLIBC_2.2.5, remove
res_send_setqhook_2_2_5: .quad 0
.balign 8
.globl _gethtent_2_2_5
.type _gethtent_2_2_5, %function
.symver _gethtent_2_2_5, _gethtent@@GLIBC_2.2.5, remove
_gethtent_2_2_5: .quad 0
.balign 8
.globl _getlong_2_2_5
.type _getlong_2_2_5, %function
.symver _getlong_2_2_5, _getlong@@GLIBC_2.2.5, remove
_getlong_2_2_5: .quad 0
.balign 8
.globl __loc_aton_2_2_5
.type __loc_aton_2_2_5, %function
.symver __loc_aton_2_2_5, __loc_aton@@GLIBC_2.2.5, remove
__loc_aton_2_2_5: .quad 0
.balign 8
.globl _gethtbyaddr_2_2_5
.type _gethtbyaddr_2_2_5, %function
.symver _gethtbyaddr_2_2_5, _gethtbyaddr@@GLIBC_2.2.5, remove
_gethtbyaddr_2_2_5: .quad 0
.balign 8
.globl __sym_ston_2_2_5
.type __sym_ston_2_2_5, %function
.symver __sym_ston_2_2_5, __sym_ston@@GLIBC_2.2.5, remove
__sym_ston_2_2_5: .quad 0
.balign 8
.globl ns_get32_2_9
.type ns_get32_2_9, %function
.symver ns_get32_2_9, ns_get32@@GLIBC_2.9, remove
ns_get32_2_9: .quad 0
.balign 8
.globl ns_parse_ttl_2_9
.type ns_parse_ttl_2_9, %function
.symver ns_parse_ttl_2_9, ns_parse_ttl@@GLIBC_2.9, remove
ns_parse_ttl_2_9: .quad 0
.balign 8
.globl __p_cdnname_2_2_5
.type __p_cdnname_2_2_5, %function
.symver __p_cdnname_2_2_5, __p_cdnname@@GLIBC_2.2.5, remove
__p_cdnname_2_2_5: .quad 0
.balign 8
.globl __res_mkquery_2_2_5
.type __res_mkquery_2_2_5, %function
.symver __res_mkquery_2_2_5, __res_mkquery@@GLIBC_2.2.5, remove
__res_mkquery_2_2_5: .quad 0
.balign 8
.globl res_send_setrhook_2_2_5
.type res_send_setrhook_2_2_5, %function
.symver res_send_setrhook_2_2_5, res_send_setrhook@@GLIBC_2.2.5, remove
res_send_setrhook_2_2_5: .quad 0
.balign 8
.globl __fp_resstat_2_2_5
.type __fp_resstat_2_2_5, %function
.symver __fp_resstat_2_2_5, __fp_resstat@@GLIBC_2.2.5, remove
__fp_resstat_2_2_5: .quad 0
.balign 8
.globl res_gethostbyname_2_2_5
.type res_gethostbyname_2_2_5, %function
.symver res_gethostbyname_2_2_5, res_gethostbyname@@GLIBC_2.2.5, remove
res_gethostbyname_2_2_5: .quad 0
.balign 8
.globl ns_parserr_2_9
.type ns_parserr_2_9, %function
.symver ns_parserr_2_9, ns_parserr@@GLIBC_2.9, remove
ns_parserr_2_9: .quad 0
.balign 8
.globl __res_dnok_2_2_5
.type __res_dnok_2_2_5, %function
.symver __res_dnok_2_2_5, __res_dnok@@GLIBC_2.2.5, remove
__res_dnok_2_2_5: .quad 0
.balign 8
.globl __res_search_2_2_5
.type __res_search_2_2_5, %function
.symver __res_search_2_2_5, __res_search@@GLIBC_2.2.5, remove
__res_search_2_2_5: .quad 0
.balign 8
.globl ns_skiprr_2_9
.type ns_skiprr_2_9, %function
.symver ns_skiprr_2_9, ns_skiprr@@GLIBC_2.9, remove
ns_skiprr_2_9: .quad 0
.balign 8
.globl __res_nameinquery_2_2_5
.type __res_nameinquery_2_2_5, %function
.symver __res_nameinquery_2_2_5, __res_nameinquery@@GLIBC_2.2.5, remove
__res_nameinquery_2_2_5: .quad 0
.balign 8
.globl __p_option_2_2_5
.type __p_option_2_2_5, %function
.symver __p_option_2_2_5, __p_option@@GLIBC_2.2.5, remove
__p_option_2_2_5: .quad 0
.balign 8
.globl ns_datetosecs_2_9
.type ns_datetosecs_2_9, %function
.symver ns_datetosecs_2_9, ns_datetosecs@@GLIBC_2.9, remove
ns_datetosecs_2_9: .quad 0
.balign 8
.globl __b64_ntop_2_2_5
.type __b64_ntop_2_2_5, %function
.symver __b64_ntop_2_2_5, __b64_ntop@@GLIBC_2.2.5, remove
__b64_ntop_2_2_5: .quad 0
.balign 8
.globl ns_samename_2_9
.type ns_samename_2_9, %function
.symver ns_samename_2_9, ns_samename@@GLIBC_2.9, remove
ns_samename_2_9: .quad 0
.balign 8
.globl __p_time_2_2_5
.type __p_time_2_2_5, %function
.symver __p_time_2_2_5, __p_time@@GLIBC_2.2.5, remove
__p_time_2_2_5: .quad 0
.balign 8
.globl _gethtbyname2_2_2_5
.type _gethtbyname2_2_2_5, %function
.symver _gethtbyname2_2_2_5, _gethtbyname2@@GLIBC_2.2.5, remove
_gethtbyname2_2_2_5: .quad 0
.balign 8
.globl __res_queriesmatch_2_2_5
.type __res_queriesmatch_2_2_5, %function
.symver __res_queriesmatch_2_2_5, __res_queriesmatch@@GLIBC_2.2.5, remove
__res_queriesmatch_2_2_5: .quad 0
.balign 8
.globl __res_isourserver_2_2_5
.type __res_isourserver_2_2_5, %function
.symver __res_isourserver_2_2_5, __res_isourserver@@GLIBC_2.2.5, remove
__res_isourserver_2_2_5: .quad 0
.balign 8
.globl ns_get16_2_9
.type ns_get16_2_9, %function
.symver ns_get16_2_9, ns_get16@@GLIBC_2.9, remove
ns_get16_2_9: .quad 0
.balign 8
.globl ns_sprintrr_2_9
.type ns_sprintrr_2_9, %function
.symver ns_sprintrr_2_9, ns_sprintrr@@GLIBC_2.9, remove
ns_sprintrr_2_9: .quad 0
.balign 8
.globl __putshort_2_2_5
.type __putshort_2_2_5, %function
.symver __putshort_2_2_5, __putshort@@GLIBC_2.2.5, remove
__putshort_2_2_5: .quad 0
.balign 8
.globl ns_subdomain_2_9
.type ns_subdomain_2_9, %function
.symver ns_subdomain_2_9, ns_subdomain@@GLIBC_2.9, remove
ns_subdomain_2_9: .quad 0
.balign 8
.globl inet_net_ntop_2_2_5
.type inet_net_ntop_2_2_5, %function
.symver inet_net_ntop_2_2_5, inet_net_ntop@@GLIBC_2.2.5, remove
inet_net_ntop_2_2_5: .quad 0
.balign 8
.globl __res_close_2_2_5
.type __res_close_2_2_5, %function
.symver __res_close_2_2_5, __res_close@@GLIBC_2.2.5, remove
__res_close_2_2_5: .quad 0
.balign 8
.globl _getshort_2_2_5
.type _getshort_2_2_5, %function
.symver _getshort_2_2_5, _getshort@@GLIBC_2.2.5, remove
_getshort_2_2_5: .quad 0
.balign 8
.globl __res_querydomain_2_2_5
.type __res_querydomain_2_2_5, %function
.symver __res_querydomain_2_2_5, __res_querydomain@@GLIBC_2.2.5, remove
__res_querydomain_2_2_5: .quad 0
.balign 8
.globl __hostalias_2_2_5
.type __hostalias_2_2_5, %function
.symver __hostalias_2_2_5, __hostalias@@GLIBC_2.2.5, remove
__hostalias_2_2_5: .quad 0
.balign 8
.globl __dn_skipname_2_2_5
.type __dn_skipname_2_2_5, %function
.symver __dn_skipname_2_2_5, __dn_skipname@@GLIBC_2.2.5, remove
__dn_skipname_2_2_5: .quad 0
.rodata
.data
.balign 8
.globl __p_class_syms_2_2_5
.type __p_class_syms_2_2_5, %object
.size __p_class_syms_2_2_5, 168
.symver __p_class_syms_2_2_5, __p_class_syms@@GLIBC_2.2.5, remove
__p_class_syms_2_2_5: .fill 168, 1, 0
.balign 8
.globl __p_type_syms_2_2_5
.type __p_type_syms_2_2_5, %object
.size __p_type_syms_2_2_5, 1104
.symver __p_type_syms_2_2_5, __p_type_syms@@GLIBC_2.2.5, remove
__p_type_syms_2_2_5: .fill 1104, 1, 0
.balign 8
.globl _res_opcodes_2_2_5
.type _res_opcodes_2_2_5, %object
.size _res_opcodes_2_2_5, 128
.symver _res_opcodes_2_2_5, _res_opcodes@@GLIBC_2.2.5, remove
_res_opcodes_2_2_5: .fill 128, 1, 0
