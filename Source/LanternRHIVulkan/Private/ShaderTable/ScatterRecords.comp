// Puts shader records where they belong: record r of Source goes to record Indices[r] of Dest. With Gather, it puts handles:
// handle Indices[r] of Source goes to record r of Dest, whose data stays.
// Mirrored by FVulkanTableScatter::FPush.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Words { uint Item[]; };
layout(push_constant, scalar) uniform Push
{
	Words Dest;
	Words Source;
	Words Indices;
	uint WordsPerRecord; // that are moved
	uint Count;
	uint DestWords; // from one record of Dest to the next
	uint Gather;
};

void main()
{
	for (uint i = gl_GlobalInvocationID.x; i < Count * WordsPerRecord; i += gl_NumWorkGroups.x * gl_WorkGroupSize.x)
	{
		const uint Record = i / WordsPerRecord;
		const uint Word = i - Record * WordsPerRecord;
		const uint Index = Indices.Item[Record];
		const uint To = Gather != 0 ? Record : Index;
		const uint From = Gather != 0 ? Index : Record;
		Dest.Item[To * DestWords + Word] = Source.Item[From * WordsPerRecord + Word];
	}
}
