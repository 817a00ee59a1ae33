# Makes a .cpp of text files: cmake -DFILES=a.js;b.css -DOUTPUT=x.cpp -DFUNCTION=GetChartFile -P EmbedText.cmake
# It defines  const char* Lantern::FUNCTION(std::string_view FileName)  which knows each by its name without folder;
# null for others.
set(Delimiter "LanternText")
set(Chunks "")
foreach(File IN LISTS FILES)
  file(READ "${File}" Text)
  get_filename_component(Name "${File}" NAME)
  string(FIND "${Text}" ")${Delimiter}\"" Found)
  if(NOT Found EQUAL -1)
    message(FATAL_ERROR "${File} contains the delimiter of the raw string that it is put into")
  endif()
  if(Name MATCHES "\\.js$")
    string(TOLOWER "${Text}" Lower)
    string(FIND "${Lower}" "</script" Found)
    if(NOT Found EQUAL -1)
      message(FATAL_ERROR "${File} contains </script, which ends the element of the page that it is put into")
    endif()
  endif()
  string(APPEND Chunks "\tif (FileName == \"${Name}\")\n\t{\n\t\treturn R\"${Delimiter}(" "${Text}" ")${Delimiter}\";\n\t}\n")
endforeach()
file(WRITE "${OUTPUT}" "// Made by EmbedText.cmake.\n#include <string_view>\n\nnamespace Lantern\n{\n\n"
  "const char* ${FUNCTION}(std::string_view FileName);\n\nconst char* ${FUNCTION}(std::string_view FileName)\n{\n"
  "${Chunks}" "\treturn nullptr;\n}\n\n} // namespace Lantern\n")
