// Surfaces that light shines through, in front of what the G-buffer shows.
#ifndef LANTERN_TRANSMISSION_LAYERS_GLSL
#define LANTERN_TRANSMISSION_LAYERS_GLSL

// Finds the next such surface along a camera ray, and returns whether there is one. It passes through the backs of single-sided ones, as
// the raster does, and through what blended ones leave clear. Origin, Left: advanced to where the ray that met it starts, and how far it may go.
bool FindLayer(FSceneConstants Scene, inout vec3 Origin, vec3 Direction, inout float Left, out FMaterialHit Hit)
{
	const uint MostBacks = 16u;
	for (uint Back = 0u; Back < MostBacks; ++Back)
	{
		SEES_HITS(true);
		Hit = TraceMaterial(Scene, MASK_TRANSMISSIVE, Origin, Direction, Left, SHOWS_ALL);
		if (Hit.Distance < 0.0) { return false; }
		bool bClear = (Hit.Flags & HIT_BLENDED) != 0u && Hit.Transmission > LeastSolidOpacity;
		if (!bClear && (Hit.Flags & HIT_CULLED_SIDE) == 0u) { return (Hit.Flags & HIT_TRANSMISSIVE) != 0u; } // else the raster shows it
		Origin = OffsetRayOrigin(Origin + Direction * Hit.Distance, -Hit.GeometricNormal, Scene.ObjectReach, Hit.Distance);
		Left -= Hit.Distance;
	}
	return false;
}

// Returns how far a camera ray may go before it meets what the G-buffer shows. Distance: to that. The raster's depth is rounded.
float DistanceBefore(float Distance) { return Distance * (1.0 - 1.0e-4); }

#endif
