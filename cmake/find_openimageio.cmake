# Debian's OpenImageIO names OpenCV's include folder, which its own headers never use and which need not be there.
find_package(OpenImageIO REQUIRED)
get_target_property(oiio_includes OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
list(FILTER oiio_includes EXCLUDE REGEX opencv)
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${oiio_includes}")
