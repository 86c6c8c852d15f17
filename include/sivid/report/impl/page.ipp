// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_PAGE_IPP
#define SIVID_REPORT_IMPL_PAGE_IPP

#include <sivid/report/page.hpp>

#include <sivid/report/detail/page_assets.hpp>

namespace sivid::report {

SIVID_DECL std::string page::str() const {
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
           escape(title_) + "</title>\n" +
           "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
           "'unsafe-inline'; script-src 'unsafe-inline'\">\n<style>" +
           std::string{page_style} + "</style>\n<script>" + std::string{page_script} +
           "</script>\n</head>\n<body>\n<main>\n" + body_ + footer_ + "</main>\n</body>\n</html>\n";
}

} // namespace sivid::report

#endif
