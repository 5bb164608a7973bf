#pragma once

#include <string_view>

namespace kestrel {

/// The style sheet of the report page.
inline constexpr std::string_view kReportStyle = R"css(
:root{color-scheme:light dark;--page:#f6f7f9;--card:#fff;--ink:#1d232b;--soft:#5d6672;
--line:#dfe3e8;--accent:#0072b2;--warn-page:#fff6e5;--warn-line:#e69f00}
@media(prefers-color-scheme:dark){:root{--page:#12161b;--card:#1a2027;--ink:#dfe5ec;--soft:#9aa5b1;
--line:#2e363f;--accent:#56b4e9;--warn-page:#2b2412;--warn-line:#b98208}}
*{box-sizing:border-box}
body{margin:0;background:var(--page);color:var(--ink);
font:15px/1.5 system-ui,-apple-system,"Segoe UI",sans-serif}
header,main,footer{max-width:1240px;margin:0 auto;padding:0 20px}
header{padding-top:28px}
h1{font-size:1.7rem;line-height:1.2;margin:0 0 6px;overflow-wrap:anywhere}
h2{font-size:1.15rem;margin:34px 0 4px}
header p,section>p{margin:0 0 12px;color:var(--soft);max-width:75ch}
.card{background:var(--card);border:1px solid var(--line);border-radius:8px;padding:12px}
.warn{background:var(--warn-page);border:1px solid var(--warn-line);border-left-width:5px;
border-radius:8px;padding:10px 16px;margin:16px 0 0}
.warn h2{margin:0;font-size:1rem}.warn ul{margin:4px 0 0;padding-left:20px}
.warn li{overflow-wrap:anywhere}
.top{display:grid;gap:16px;grid-template-columns:repeat(auto-fit,minmax(min(100%,430px),1fr));
align-items:start;margin-top:20px}
.tables{display:grid;gap:6px 28px;align-items:start;
grid-template-columns:repeat(auto-fit,minmax(min(100%,380px),1fr))}
table{border-collapse:collapse;width:100%}
caption{text-align:left;font-weight:600;padding:6px 0 2px}
th,td{text-align:left;font-weight:400;padding:3px 0;border-bottom:1px solid var(--line);
vertical-align:baseline;overflow-wrap:anywhere}
tr:last-child>*{border-bottom:0}
td.n{text-align:right;font-variant-numeric:tabular-nums;font-weight:600;padding-left:12px;overflow-wrap:normal}
td.u{color:var(--soft);padding-left:6px;width:4.5em;overflow-wrap:normal}
.wide{overflow-x:auto;margin-bottom:14px}
.wide th,.wide td{padding:3px 8px;white-space:nowrap}
.wide th{vertical-align:bottom;color:var(--soft);font-size:.87rem;white-space:normal;
overflow-wrap:normal;line-height:1.25}
.wide td:not(.n){white-space:normal;overflow-wrap:normal}.wide th.n{text-align:right}.wide td.n{font-weight:400}
.wide tbody tr:hover{background:var(--page)}
video{display:block;width:100%;border-radius:5px;background:#000}
figure{margin:0}
.plots{columns:2 470px;column-gap:14px}
.plots figure{margin-bottom:14px;break-inside:avoid}
.plots svg{display:block;width:100%;height:auto}
.sheet{display:grid;gap:12px;grid-template-columns:repeat(auto-fill,minmax(min(100%,340px),1fr))}
.sheet img{display:block;width:100%;height:auto;border-radius:4px}
figcaption{color:var(--soft);font-size:.87rem;padding-top:6px}
pre{margin:0;overflow-x:auto;font:13px/1.45 ui-monospace,"DejaVu Sans Mono",Menlo,monospace}
a{color:var(--accent)}
footer{color:var(--soft);font-size:.87rem;padding-top:26px;padding-bottom:40px}
@media(max-width:560px){header,main,footer{padding-left:12px;padding-right:12px}.card{padding:8px}}
@media print{:root{--page:#fff;--card:#fff;--ink:#000;--soft:#444;--line:#ccc}
body{font-size:11px}figure,table,.warn{break-inside:avoid}h2{break-after:avoid}video{display:none}
pre{white-space:pre-wrap}.plots{columns:2}.sheet{grid-template-columns:1fr 1fr 1fr}}
)css";

}  // namespace kestrel
