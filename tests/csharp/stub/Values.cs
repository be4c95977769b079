// SPDX-License-Identifier: MIT
// The values of Godot's C# interface, as far as the addon's classes use them.
using System;
using System.Collections;
using System.Collections.Generic;

namespace Godot
{
	public struct Vector2
	{
		public float X, Y;
		public Vector2(float x, float y) { X = x; Y = y; }
		public static Vector2 operator +(Vector2 a, Vector2 b) { return new Vector2(a.X + b.X, a.Y + b.Y); }
		public static Vector2 operator *(Vector2 a, float b) { return new Vector2(a.X * b, a.Y * b); }
		public static readonly Vector2 Up = new Vector2(0, -1);
	}

	public struct Vector2I { public int X, Y; public Vector2I(int x, int y) { X = x; Y = y; } }
	public struct Transform2D { public Vector2 X, Y, Origin; public Transform2D(float rotation, Vector2 origin) { X = new Vector2(1, 0); Y = new Vector2(0, 1); Origin = origin; } }
	public struct Color { public float R, G, B, A; public Color(float r, float g, float b, float a = 1) { R = r; G = g; B = b; A = a; } }
	public struct Rid { public ulong Id; }

	public sealed class StringName
	{
		private readonly string _name;
		public StringName(string name) { _name = name; }
		public static implicit operator StringName(string from) { return new StringName(from); }
		public static implicit operator string(StringName from) { return from == null ? null : from._name; }
		public override string ToString() { return _name; }
	}

	public sealed class NodePath
	{
		private readonly string _path;
		public NodePath(string path) { _path = path; }
		public static implicit operator NodePath(string from) { return new NodePath(from); }
		public override string ToString() { return _path; }
	}

	public struct Callable
	{
		public Delegate Delegate;
		public static Callable From(Action action) { return new Callable { Delegate = action }; }
		public static Callable From<T0>(Action<T0> action) { return new Callable { Delegate = action }; }
		public static Callable From<T0, T1>(Action<T0, T1> action) { return new Callable { Delegate = action }; }
		public static Callable From<T0, T1, T2>(Action<T0, T1, T2> action) { return new Callable { Delegate = action }; }
		public static Callable From<T0, T1, T2, T3>(Action<T0, T1, T2, T3> action) { return new Callable { Delegate = action }; }
	}

	/// Holds what it was made of. Read as another type than the engine would convert it to, it throws.
	public struct Variant
	{
		public object Held;

		private T As<T>() { return Held == null ? default(T) : (T)Held; }
		public bool AsBool() { return As<bool>(); }
		public int AsInt32() { return checked((int)As<long>()); }
		public long AsInt64() { return As<long>(); }
		public uint AsUInt32() { return checked((uint)As<long>()); }
		public double AsDouble() { return As<double>(); }
		public string AsString() { return As<string>(); }
		public Vector2 AsVector2() { return As<Vector2>(); }
		public Vector2I AsVector2I() { return As<Vector2I>(); }
		public Transform2D AsTransform2D() { return As<Transform2D>(); }
		public Color AsColor() { return As<Color>(); }
		public Rid AsRid() { return As<Rid>(); }
		public NodePath AsNodePath() { return As<NodePath>(); }
		public GodotObject AsGodotObject() { return As<GodotObject>(); }
		public byte[] AsByteArray() { return As<byte[]>(); }
		public int[] AsInt32Array() { return As<int[]>(); }
		public float[] AsFloat32Array() { return As<float[]>(); }
		public string[] AsStringArray() { return As<string[]>(); }
		public Vector2[] AsVector2Array() { return As<Vector2[]>(); }
		public Color[] AsColorArray() { return As<Color[]>(); }
		public Collections.Array AsGodotArray() { return As<Collections.Array>() ?? new Collections.Array(); }
		public Collections.Dictionary AsGodotDictionary() { return As<Collections.Dictionary>(); }

		public static implicit operator Variant(bool from) { return new Variant { Held = from }; }
		public static implicit operator Variant(int from) { return new Variant { Held = (long)from }; }
		public static implicit operator Variant(uint from) { return new Variant { Held = (long)from }; }
		public static implicit operator Variant(long from) { return new Variant { Held = from }; }
		public static implicit operator Variant(float from) { return new Variant { Held = (double)from }; }
		public static implicit operator Variant(double from) { return new Variant { Held = from }; }
		public static implicit operator Variant(string from) { return new Variant { Held = from }; }
		public static implicit operator Variant(Vector2 from) { return new Variant { Held = from }; }
		public static implicit operator Variant(Vector2I from) { return new Variant { Held = from }; }
		public static implicit operator Variant(Transform2D from) { return new Variant { Held = from }; }
		public static implicit operator Variant(Color from) { return new Variant { Held = from }; }
		public static implicit operator Variant(Rid from) { return new Variant { Held = from }; }
		public static implicit operator Variant(NodePath from) { return new Variant { Held = from }; }
		public static implicit operator Variant(StringName from) { return new Variant { Held = from }; }
		public static implicit operator Variant(GodotObject from) { return new Variant { Held = from }; }
		public static implicit operator Variant(byte[] from) { return new Variant { Held = from }; }
		public static implicit operator Variant(int[] from) { return new Variant { Held = from }; }
		public static implicit operator Variant(float[] from) { return new Variant { Held = from }; }
		public static implicit operator Variant(string[] from) { return new Variant { Held = from }; }
		public static implicit operator Variant(Vector2[] from) { return new Variant { Held = from }; }
		public static implicit operator Variant(Color[] from) { return new Variant { Held = from }; }
		public static implicit operator Variant(Collections.Array from) { return new Variant { Held = from }; }
		public static implicit operator Variant(Collections.Dictionary from) { return new Variant { Held = from }; }
	}
}

namespace Godot.Collections
{
	public class Array : IEnumerable<Variant>
	{
		private readonly List<Variant> _items = new List<Variant>();
		public int Count { get { return _items.Count; } }
		public Variant this[int index] { get { return _items[index]; } set { _items[index] = value; } }
		public void Add(Variant item) { _items.Add(item); }
		public IEnumerator<Variant> GetEnumerator() { return _items.GetEnumerator(); }
		IEnumerator IEnumerable.GetEnumerator() { return _items.GetEnumerator(); }
	}

	public class Dictionary
	{
		private readonly Dictionary<string, Variant> _items = new Dictionary<string, Variant>();
		public Variant this[Variant key] { get { return _items[key.Held.ToString()]; } set { _items[key.Held.ToString()] = value; } }
	}
}
