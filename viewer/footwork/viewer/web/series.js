// The last so many numbers of a measurement.
export class Series {
  constructor(most) {
    this.most = most;
    this.values = [];
    this.count = 0;
  }

  add(value) {
    this.count += 1;
    this.values.push(value);
    if (this.values.length > this.most) this.values.shift();
  }

  get newest() {
    return this.values.at(-1);
  }

  quantile(share) {
    if (this.values.length === 0) return NaN;
    const sorted = [...this.values].sort((a, b) => a - b);
    return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
  }
}
