// The bindless descriptor set and typed buffer references. Every shader uses this one layout (see RTInterfaces.h).
#ifndef LANTERN_BINDINGS_GLSL
#define LANTERN_BINDINGS_GLSL

#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_shader_image_load_formatted : require
#extension GL_EXT_shader_explicit_arithmetic_types_int16 : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#include "../Shared/SceneTypes.h"

layout(set = 0, binding = 0) uniform texture2D Textures[];
layout(set = 0, binding = 1) uniform image2D Images[];
layout(set = 0, binding = 2) uniform sampler Samplers[];

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FSceneRef { FSceneConstants Data; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FViewRef { FViewConstants Data; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FObjectRef { FObjectData Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FObjectMotionRef { FObjectMotion Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FSectionRef { FSectionData Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FMaterialRef { FMaterialData Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FLightRef { FLightData Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FEmissiveRef { FEmissiveTriangle Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FEmissiveClusterRef { FEmissiveCluster Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FEmissiveRangeRef { FEmissiveRange Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FEmissivePowerRef
{
	FEmissivePowerHeader Header;
	FEmissivePower Data[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FPositionRef { vec3 Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FAttributeRef { FVertexAttributes Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FIndexRef { uint Data[]; };

// Returns the offset from the scene's origin to the centre of Cell, in metres. It is exact in fp32; so is its sum with a
// translation of similar size and opposite sign.
vec3 CellOffset(FSceneConstants Scene, ivec3 Cell) { return vec3(Cell - Scene.OriginCell) * CELL_SIZE - Scene.OriginInCell; }

#endif
