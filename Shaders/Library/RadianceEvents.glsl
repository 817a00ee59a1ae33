// What lamps that have changed bring to a place, more or less.
#ifndef LANTERN_RADIANCE_EVENTS_GLSL
#define LANTERN_RADIANCE_EVENTS_GLSL

#include "../Shared/RadianceCellTypes.h"
#include "Bindings.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FRadianceEventRef { FRadianceEvent Data[]; };

// Returns about the change of irradiance / π. Light that comes by a surface is taken for as much as what comes straight.
// P: relative to the scene's origin, metres.
float GetLampChange(FAddress Events, uint Count, vec3 P)
{
	const float Nearest = 0.5; // metres
	float Sum = 0.0;
	for (uint I = 0u; I < Count; ++I)
	{
		FRadianceEvent Event = FRadianceEventRef(Events).Data[I];
		float Distance = max(distance(P, Event.Center), Nearest);
		if (Event.Radius < 0.0) { Sum += Event.Strength; }
		else if (Distance < max(Event.Radius, Nearest)) { Sum += (Event.Strength + 2.0 * Event.Moved / Distance) / (Distance * Distance); }
	}
	return Sum * (1.0 / 3.14159265);
}

#endif
