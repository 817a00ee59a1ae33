// Bindings and constants of the contract tests' shaders; mirrored by FContractPush in ContractShaders.h.
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_image_load_formatted : require

layout(buffer_reference, scalar) buffer Words { uint Item[]; };
layout(buffer_reference, scalar) buffer Floats { float Item[]; };
layout(push_constant, scalar) uniform Push
{
	Words Output;
	Floats Input;
	uint A, B, C, D, E, F, G, H;
};

layout(set = 0, binding = 0) uniform texture2D Textures[];
layout(set = 0, binding = 1) uniform image2D Images[];
layout(set = 0, binding = 2) uniform sampler Samplers[];
