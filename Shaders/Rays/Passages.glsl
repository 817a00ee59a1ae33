// Paths through surfaces that transmit, and through volumes behind them. PathTracing.glsl includes it if HAS_TRANSMISSION is defined.
#ifndef LANTERN_PASSAGES_GLSL
#define LANTERN_PASSAGES_GLSL

#if defined(HAS_SCATTERING) && defined(RADIANCE_CELLS)
#define SCATTERS_BY_CELLS
#endif

// What a path through surfaces that transmit has with it.
struct FPassages
{
	FVolume Volume; // that the path is in
	float Slope;    // cosine of the path's last part against the surface by which it has entered that
	uint Left;      // surfaces that it may still meet
	// Since it was last scattered, or reflected by such a surface:
	float Length;        // of what it has passed
	float EmissionShare; // of emitters that light sampling lists
	uint Mask;           // of its rays
#ifdef SCATTERS_BY_CELLS
	vec3 Scattered; // towards the viewer, by what it has passed behind its last surface
#endif
};

// FPassages::Volume and Slope of the next path, if it starts in a volume. The thread may set them before.
FVolume FirstVolume = Air();
float FirstSlope = 0.0;

float FirstEmissionShare = 1.0; // FPassages::EmissionShare of paths that begin

FPassages StartPassages()
{
	FPassages Passages;
	Passages.Volume = FirstVolume;
	Passages.Slope = FirstSlope;
	Passages.Left = MostPassages;
	Passages.Length = 0.0;
	Passages.EmissionShare = FirstEmissionShare;
	Passages.Mask = GatherMask;
#ifdef SCATTERS_BY_CELLS
	Passages.Scattered = vec3(0.0);
#endif
	return Passages;
}

// Returns what the volume that a path is in leaves of what it meets next.
vec3 LeftByVolume(FPassages Passages, FMaterialHit Hit)
{
	float Length = Hit.Distance < 0.0 ? Infinity : Hit.Distance;
	vec3 Extinction = Passages.Volume.Extinction;
#ifdef SCATTERS_BY_CELLS
	if (Hit.Transmission <= 0.0) { Extinction = SeenExtinction(Passages.Volume); }
#endif
	vec3 Left = exp(-Extinction * Length);
#ifndef TINTED_SHADOWS
	// What lies in a volume is lit through it, which no ray to a light tells: from straight above. What shines is not.
	if (Hit.Transmission <= 0.0 && Hit.Emissive == vec3(0.0)) { Left *= exp(-DownwardExtinction(Passages.Volume) * (Length * Passages.Slope)); }
#endif
	return Left;
}

void ScatterPassages(inout FPassages Passages)
{
	Passages.Length = Passages.Slope = 0.0;
	Passages.EmissionShare = 1.0;
	Passages.Mask = MASK_VISIBLE;
}

#ifdef SCATTERS_BY_CELLS
// The share of light that the surface of a volume lets in.
vec3 LetIn(FMaterialHit Surface, float Fresnel) { return InterfaceTint(Surface) * (InterfaceShare(Surface) * (1.0 - Surface.Specular * Fresnel)); }

// Returns what a volume behind a surface scatters towards a viewer, from light that arrives on the surface. Origin, Before: of the ray that has
// met the surface. Direction, Length: of its way within; below 0: without end.
vec3 FindScattered(FSceneConstants Scene, FMaterialHit Surface, vec3 Origin, vec3 Before, vec3 Direction, float Length, float U)
{
	const float EvenFresnel = 1.0 / 21.0; // mean of Schlick's weight over a cosine
	FVolume Volume = VolumeOf(Scene, Surface);
	if (!Scatters(Volume)) { return vec3(0.0); }
	vec3 Ng = Surface.GeometricNormal, P = OffsetRayOrigin(Origin + Before * Surface.Distance, Ng, Scene.ObjectReach, Surface.Distance);
	FCellLight Light;
	const float LeastLength = 1.0; // metres: of a ray that has led there. Water is flat, so cells near the eye may be as large
	if (!LookUpPlace(P, Ng, Surface.Normal, max(Surface.Distance, LeastLength), U, Light)) { return vec3(0.0); }
	mat3 Basis = MakeBasis(Ng);
	FSplitLight Split = SplitCellLight(Light.From * Basis);
	float Index = IndexOf(Surface.F0), Squared = Index * Index;
	FWaterRay Ray = FWaterRay(Volume.Extinction * (Length < 0.0 ? Infinity : Length), clamp(-dot(Direction, Ng), 0.01, 1.0), Index);
	// Even light is within a cone then, and counts as if it came from that one's mean.
	float EvenCosine = 0.5 / (Squared * (1.0 - sqrt(max(1.0 - 1.0 / Squared, 0.0))));
	vec3 Even = LetIn(Surface, mix(Surface.F0, 1.0, EvenFresnel)) * GatherScattered(Volume, Ray, EvenCosine, -Ray.Slope * EvenCosine);
	float Bent = sqrt(max(1.0 - (1.0 - Split.From.z * Split.From.z) / Squared, 1.0e-4));
	vec3 Aimed = LetIn(Surface, mix(Surface.F0, 1.0, SchlickWeight(Split.From.z))) * GatherScattered(Volume, Ray, Bent, dot(Basis * Split.From, Direction));
	return Pi * Light.Irradiance * mix(Even, Aimed, Split.Share);
}
#endif

// Takes a path on if it meets an interface at Hit, and returns whether it does: else the surface reflects as others do. A path that ends here
// has a throughput of 0. Origin, Direction: of the ray that met Hit, and of the next one, whose hit Hit becomes. bShown: see FollowPath.
// A path that goes through keeps the density of its direction. Light sampling at the vertex before found lights straight behind; what bends
// counts as if it did not. One that is reflected leads where light sampling finds nothing.
bool TakePassage(FSceneConstants Scene, bool bShown, inout FMaterialHit Hit, inout FPassages Passages, inout vec3 Origin, inout vec3 Direction,
                 inout vec3 Throughput, inout float Pdf, inout FRandom Random)
{
	if (Hit.Transmission <= 0.0) { return false; }
	vec4 U = NextRandom4(Random);
#ifdef LIKELIEST_PASSAGE
	U.w = 0.5;
#endif
	if (U.w >= InterfaceShare(Hit)) { return false; }
	bool bInside = (Hit.Flags & HIT_INSIDE) != 0u;
	bool bKnows = !bInside || !IsAir(Passages.Volume); // a path that has begun in the volume did not know of it
#ifdef SCATTERS_BY_CELLS
	bKnows = bKnows || Scatters(VolumeOf(Scene, Hit)); // what such a volume takes from the path, it scatters into it
#endif
	if (!bKnows)
	{
		Passages.Volume = VolumeOf(Scene, Hit);
		float Way = Hit.Distance;
#ifndef TINTED_SHADOWS
		Way *= 1.0 - abs(dot(Direction, Hit.GeometricNormal)); // who sees where it has begun counts the way straight down, see LeftByVolume
#endif
		Throughput *= exp(-Passages.Volume.Extinction * Way);
	}
	mat3 Basis = MakeBasis(BendNormal(Hit.Normal, -Direction));
#ifdef LIKELIEST_PASSAGE
	U.z = 0.5;
#endif
	FPassage Passage = SamplePassage(Hit, Basis, -Direction * Basis, U.xyz);
	if (!IsClear(Hit)) { Throughput *= Passages.Left-- > 0u ? Passage.Weight : vec3(0.0); }
	if (Throughput == vec3(0.0)) { return true; }
	Passages.Length += Hit.Distance;
	if (!Passage.bThrough)
	{
		Pdf = uintBitsToFloat(0x7f800000u);
		ScatterPassages(Passages);
		if (bInside) { Passages.Slope = abs(dot(Passage.Direction, Hit.GeometricNormal)); }
	}
	else if ((Hit.Flags & HIT_SOLID) != 0u) 
	{
		Passages.Volume = bInside ? Air() : VolumeOf(Scene, Hit);
		Passages.Slope = abs(dot(Passage.Direction, Hit.GeometricNormal));
	}
	vec3 Side = Passage.bThrough ? -Hit.GeometricNormal : Hit.GeometricNormal;
	vec3 From = Origin, Before = Direction;
	Origin = OffsetRayOrigin(Origin + Direction * Hit.Distance, Side, Scene.ObjectReach, Hit.Distance);
	Direction = Passage.Direction;
	WidenRayCone(Hit.Distance);
	FMaterialHit Next = TraceMaterial(Scene, Passages.Mask, Origin, Direction, Infinity, bShown ? SHOWS_ALL : SHOWS_NOTHING);
#ifdef SCATTERS_BY_CELLS
	Passages.Scattered = vec3(0.0);
	if (Passage.bThrough && !bInside) { Passages.Scattered = FindScattered(Scene, Hit, From, Before, Direction, Next.Distance, ChooseLevel(Random)); }
#endif
	Hit = Next;
	if (Hit.EmissiveWeight > 0.0) { Hit.Emissive *= Passages.EmissionShare; }
	return true;
}

#if defined(HAS_SCATTERING) && !defined(SCATTERS_BY_CELLS)
// Scatters a path in the volume that it is in, before it meets Hit, or lets it pass. Returns whether it was scattered, and Hit is then what it
// meets next. A path that ends has a throughput of 0. Ways are those of one channel, chosen by the throughput, and weighed for all.
bool TakeScattering(FSceneConstants Scene, inout FPassages Passages, inout FMaterialHit Hit, inout vec3 Origin, inout vec3 Direction,
                    inout vec3 Throughput, inout float Pdf, inout vec3 Radiance, inout uint Bounce, uint MaxBounces, inout FRandom Random)
{
	FVolume Volume = Passages.Volume;
	float Sum = Throughput.r + Throughput.g + Throughput.b;
	if (!Scatters(Volume) || Sum <= 0.0) { return false; }
	vec3 Shares = Throughput / Sum;
	vec4 U = NextRandom4(Random);
	float Chosen = U.x < Shares.r ? Volume.Extinction.r : (U.x < Shares.r + Shares.g ? Volume.Extinction.g : Volume.Extinction.b);
	float Length = Hit.Distance < 0.0 ? Infinity : Hit.Distance, Way = Chosen > 0.0 ? -log(1.0 - U.y) / Chosen : Infinity;
	if (Way >= Length)
	{
		Throughput /= dot(Shares, exp(-Volume.Extinction * Length));
		return false;
	}
	vec3 Left = Volume.Extinction * exp(-Volume.Extinction * Way);
	Throughput *= Bounce < MaxBounces ? Volume.Albedo * Left / max(dot(Shares, Left), 1.0e-30) : vec3(0.0);
	if (Throughput == vec3(0.0)) { return false; }
	vec3 Lit = Throughput;
#ifdef TINTED_SHADOWS
	PlaceVolume = Volume;
#else
	Lit *= exp(-DownwardExtinction(Volume) * (Way * Passages.Slope)); // see LeftByVolume
#endif
	++Bounce;
	Origin += Direction * Way;
#ifdef HAS_DIFFUSE_TRANSMISSION
	BackStep = vec3(0.0);
#endif
	bScattersThere = true;
	Radiance += Lit * SampleLights(Scene, MakePhase(Volume.Anisotropy), MakeBasis(-Direction), vec3(0.0, 0.0, 1.0), Origin, -Direction, false,
	                                      AllChannels, SHOWS_NOTHING, Random);
	bScattersThere = false;
	if (Bounce >= 3u && EndsByRoulette(Throughput, Random))
	{
		Throughput = vec3(0.0);
		return false;
	}
	vec3 Local = SamplePhase(Volume.Anisotropy, U.zw);
	Direction = MakeBasis(Direction) * Local;
	Pdf = PhaseFunction(Local.z, Volume.Anisotropy);
	ScatterPassages(Passages);
	RayCone = vec2(0.0);
	Hit = TraceMaterial(Scene, MASK_VISIBLE, Origin, Direction, Infinity, SHOWS_NOTHING);
	return true;
}
#endif

// Takes a path through the volume that it is in, up to Hit, and returns whether that has scattered it. A path that ends there has a throughput
// of 0.
bool PassVolume(FSceneConstants Scene, inout FPassages Passages, inout FMaterialHit Hit, inout vec3 Origin, inout vec3 Direction, inout vec3 Throughput,
                inout float Pdf, inout vec3 Radiance, inout uint Bounce, uint MaxBounces, inout FRandom Random)
{
	bool bScattered = false;
#ifdef SCATTERS_BY_CELLS
	Radiance += Throughput * Passages.Scattered;
	Passages.Scattered = vec3(0.0);
#elif defined(HAS_SCATTERING)
	while (TakeScattering(Scene, Passages, Hit, Origin, Direction, Throughput, Pdf, Radiance, Bounce, MaxBounces, Random)) { bScattered = true; }
#endif
	Throughput *= LeftByVolume(Passages, Hit);
	return bScattered;
}

#endif
