// Sums the power of clusters of emissive triangles, for paths that choose one of them. One work group does all.
// NO_FLOOR: see EmissiveTriangles.comp.
#version 460
#include "../Shared/EmissiveTypes.h"
#include "../Library/Bindings.glsl"
#include "EmissiveShares.glsl"

layout(local_size_x = EMISSIVE_POWERS_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FEmissiveConstants Push; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer FPowersRef
{
	FEmissivePowerHeader Header;
	FEmissivePower Data[];
};

shared float Sums[EMISSIVE_POWERS_GROUP_SIZE];
shared uint Counts[EMISSIVE_POWERS_GROUP_SIZE];

void main()
{
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	FPowersRef Powers = FPowersRef(Scene.EmissivePowers);
	uint Place = gl_LocalInvocationIndex, Total = Scene.EmissiveClusterCount;
	uint Each = (Total + EMISSIVE_POWERS_GROUP_SIZE - 1u) / EMISSIVE_POWERS_GROUP_SIZE;
	uint First = min(Place * Each, Total), End = min(First + Each, Total);
	float Power = 0.0;
	uint Count = 0u;
	for (uint I = First; I < End; ++I)
	{
		Power += Powers.Data[I].Power;
		Count += Powers.Data[I].Power > 0.0 ? 1u : 0u;
	}
	Sums[Place] = Power;
	Counts[Place] = Count;
	barrier();
	Power = 0.0;
	Count = 0u;
	for (uint I = 0u; I < EMISSIVE_POWERS_GROUP_SIZE; ++I)
	{
		Power += Sums[I];
		Count += Counts[I];
	}
	barrier();
	float Share = 0.0;
	for (uint I = First; I < End; ++I) { Share += ShareOf(Powers.Data[I].Power, Power, Count); }
	Sums[Place] = Share;
	barrier();
	Share = 0.0;
	for (uint I = 0u; I < Place; ++I) { Share += Sums[I]; }
	for (uint I = First; I < End; ++I)
	{
		Share += ShareOf(Powers.Data[I].Power, Power, Count);
		Powers.Data[I].Share = I + 1u < Total ? min(Share, 1.0) : 1.0;
	}
	if (Place == 0u) { Powers.Header = FEmissivePowerHeader(Power, 0u); }
}
