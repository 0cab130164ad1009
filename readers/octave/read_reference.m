% Print case, quantity and value of a CSV file of reference values: octave-cli --no-history read_reference.m FILE.csv
1;

function stop(varargin)
  fprintf(stderr, ["read_reference: " varargin{1} "\n"], varargin{2:end});
  exit(1);
end

args = argv();
if numel(args) < 1 || (file = fopen(args{end}, "r")) < 0
  stop("cannot read the file");
end
fgetl(file);
k = 0; rows = -1;
while ischar(line = fgetl(file))
  k = k + 1;
  if any(line < 32 | line > 126)
    stop("row %d is damaged", k);
  end
  cells = strsplit(line, ",", "CollapseDelimiters", false);
  count = sscanf(cells{1}, "%d/%d");
  if numel(cells) != 12 || numel(cells{11}) != 64 || numel(cells{12}) != 8 || numel(count) != 2 || count(1) != k
    stop("row %d is damaged", k);
  end
  rows = count(2);
  value = str2double(cells{4});
  if !isreal(value) || !isfinite(value)
    stop("row %d: %s is no finite number", k, cells{4});
  end
  bytes = double(line(1:end-9)); n = numel(bytes);
  check = mod(n + sum((n:-1:1) .* bytes), 65521) * 65536 + mod(1 + sum(bytes), 65521);
  if check != hex2dec(cells{12})
    stop("row %d has the wrong checksum", k);
  end
  printf("%s,%s,%.17g\n", cells{2}, cells{3}, value);
end
if k != rows
  stop("%d rows, %d are announced", k, rows);
end
