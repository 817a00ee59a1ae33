// Lists the lights that have changed since the last frame, with what they were, and keeps what all of them are.
#version 460
#include "../Shared/LampChangeTypes.h"
#include "../Library/Bindings.glsl"

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FListChangesConstants Push; };

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FWordRef { uint Data[]; };

void main()
{
	uint Light = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * TILE_PIXELS + gl_LocalInvocationIndex;
	if (Light >= Push.Count) { return; }
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	FWordRef Kept = FWordRef(Push.Kept + Light * LAMP_WORDS * 4u), List = FWordRef(Push.List), Table = FWordRef(Scene.Lights);
	uint Before[LAMP_WORDS];
	bool bChanged = false;
	for (uint I = 0u; I < LAMP_WORDS; ++I)
	{
		uint Now = Light < Scene.LightCount ? Table.Data[Light * LAMP_WORDS + I] : 0u;
		Before[I] = Kept.Data[I];
		bChanged = bChanged || Before[I] != Now;
		Kept.Data[I] = Now;
	}
	if (!bChanged || Push.bFresh != 0u) { return; }
	uint Place = atomicAdd(List.Data[0], 1u);
	if (Place >= LAMP_CHANGES) { return; }
	uint First = 2u + Place * (1u + LAMP_WORDS); // behind both counts
	List.Data[First] = Light;
	for (uint I = 0u; I < LAMP_WORDS; ++I) { List.Data[First + 1u + I] = Before[I]; }
}
