// Puts shader records where they belong: record r of Source goes to record Indices[r] of Dest.
// Mirrored by FVulkanTableScatter::FPush.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(buffer_reference, scalar) buffer Words { uint Item[]; };
layout(push_constant, scalar) uniform Push
{
	Words Dest;
	Words Source;
	Words Indices;
	uint WordsPerRecord;
	uint Count;
};

void main()
{
	for (uint i = gl_GlobalInvocationID.x; i < Count * WordsPerRecord; i += gl_NumWorkGroups.x * gl_WorkGroupSize.x)
	{
		const uint Record = i / WordsPerRecord;
		const uint Word = i - Record * WordsPerRecord;
		Dest.Item[Indices.Item[Record] * WordsPerRecord + Word] = Source.Item[i];
	}
}
