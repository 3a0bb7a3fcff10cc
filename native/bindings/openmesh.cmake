# The target OpenMeshCore as a static library, of the sources that a mesh in memory needs; Debian has a shared one only.
file(GLOB openmesh_sources
  ${ATLAS_REFINE_PORTABLE}/src/OpenMesh/Core/Mesh/*.cc
  ${ATLAS_REFINE_PORTABLE}/src/OpenMesh/Core/System/*.cc
  ${ATLAS_REFINE_PORTABLE}/src/OpenMesh/Core/Utils/*.cc)
if(NOT openmesh_sources)
  message(FATAL_ERROR "ATLAS_REFINE_PORTABLE: no source of OpenMesh in ${ATLAS_REFINE_PORTABLE}")
endif()
add_library(OpenMeshCore STATIC ${openmesh_sources})
target_include_directories(OpenMeshCore SYSTEM PUBLIC ${ATLAS_REFINE_PORTABLE}/src)
target_compile_options(OpenMeshCore PRIVATE -w)
