# Writes OUTPUT: libs/report/assets.h's constants from ASSETS, the page (.html), its style (.css) and its scripts (.js).
set(page "")
set(style "")
set(script "")
foreach(asset ${ASSETS})
  file(READ ${asset} text)
  # A string literal may be as long as the longest page needs, but the standard promises only 64 KiB: one literal a file.
  set(literal "R\"asset(${text})asset\"\n")
  if(asset MATCHES "\\.html$")
    string(APPEND page "${literal}")
  elseif(asset MATCHES "\\.css$")
    string(APPEND style "${literal}")
  else()
    string(APPEND script "${literal}")
  endif()
endforeach()
file(WRITE ${OUTPUT} "#include \"report/assets.h\"\n\nnamespace vsgl::report {\n
const std::string_view kPage =\n${page};\nconst std::string_view kStyle =\n${style};\nconst std::string_view kScript =\n${script};\n
}  // namespace vsgl::report\n")
