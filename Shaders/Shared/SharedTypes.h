// Types that C++ and GLSL share: vector names and integer types with one meaning on both sides. GLSL uses scalar block layout
// everywhere, so that C++ structs of 4-byte members match without padding rules.
#ifndef LANTERN_SHARED_TYPES_H
#define LANTERN_SHARED_TYPES_H

#define RAY_QUERY_GROUP_SIZE 8 // threads in x and y of passes that trace by ray queries

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
#define LANTERN_SHARED_BEGIN namespace Lantern {
#define LANTERN_SHARED_END }
LANTERN_SHARED_BEGIN
using uint = uint32_t;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
using mat4 = glm::mat4;
using ivec3 = glm::ivec3;
using FAddress = uint64_t; ///< device address
LANTERN_SHARED_END
#define LANTERN_ASSERT_SIZE(Type, Bytes) static_assert(sizeof(Type) == Bytes, "shared with shaders")
#else
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_nonuniform_qualifier : require
#define LANTERN_SHARED_BEGIN
#define LANTERN_SHARED_END
#define FAddress uint64_t
#define LANTERN_ASSERT_SIZE(Type, Bytes)
#endif

#endif
