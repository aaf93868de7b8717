# cmake -DROOT=<tree> -DBATCH=<file to write> -P batch.cmake <test file>...: test files as one
# source. Every one has an unnamed namespace with helpers of its own: here that is within one of the
# file's name, so that two files may each have a `drive()`. Places in messages and debuggers are the
# files' own.
set(text "")
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(i RANGE 5 ${last})
  set(path ${CMAKE_ARGV${i}})
  file(READ ${ROOT}/${path} file)
  get_filename_component(folder ${path} DIRECTORY)
  string(MAKE_C_IDENTIFIER ${path} name)
  string(REGEX MATCHALL "#include \"[^\"]+\"" includes "${file}")
  foreach(include ${includes})
    string(REGEX REPLACE ".*\"(.*)\"" "\\1" header ${include})
    if(EXISTS ${ROOT}/${folder}/${header})
      string(REPLACE "${include}" "#include \"${folder}/${header}\"" file "${file}")
    endif()
  endforeach()
  string(REPLACE "\nnamespace {\n" "\nnamespace ${name} { namespace {\n" file "${file}")
  string(REPLACE "\n}  // namespace\n" "\n} }  // namespace\n" file "${file}")
  string(APPEND text "#line 1 \"${path}\"\n${file}")
endforeach()
file(WRITE ${BATCH} "${text}")
